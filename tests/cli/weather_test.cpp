#include "base/whole_file.h"
#include "meshing/io/mesh_io.h"
#include "meshing/mesh/topology.h"
#include "tests/cli/scree.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramRun;
using testing::HasSubstr;

class Weather : public testing::Test {
protected:
    void SetUp() override { meshing::write_mesh(at("cube.obj"), {test::cube(8), {}}); }
    fs::path at(const std::string& name) const { return dir_ / name; }
    std::string bytes_of(const std::string& name) const {
        return read_whole_file(at(name), std::size_t{1} << 26);
    }

    test::TempDir dir_;
};

TEST_F(Weather, WritesTheMeshAndItsPictures) {
    const ProgramRun run = test::scree({"weather", at("cube.obj"), "-o", at("worn.ply"), "--steps",
                                        "30", "--before-after", at("both.png"), "--turntable",
                                        at("turn.png"), "--curvature-colours", "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_EQ(report["steps"], 30);
    EXPECT_EQ(report["self_intersections"], 0);
    EXPECT_LT(report["volume_after_m3"], report["volume_before_m3"]);
    const auto worn = meshing::read_mesh(at("worn.ply"));
    EXPECT_EQ(meshing::solid_defect(worn.mesh), "");
    EXPECT_EQ(worn.colours.size(), worn.mesh.positions.size());
    EXPECT_GT(vision::read_photo(at("both.png")).pixels.width(), 1200);
    EXPECT_GT(vision::read_photo(at("turn.png")).pixels.width(), 1900);
}

TEST_F(Weather, GivesTheSameBytesForAnyThreadCount) {
    for (const char* threads : {"1", "2"}) {
        const std::string name = std::string("worn") + threads + ".off";
        const ProgramRun run = test::scree({"weather", at("cube.obj"), "-o", at(name), "--steps",
                                            "12", "--threads", threads, "--quiet"});
        ASSERT_EQ(run.status, 0) << run.errors;
        EXPECT_EQ(run.output, "");
    }
    EXPECT_EQ(bytes_of("worn1.off"), bytes_of("worn2.off"));
}

TEST_F(Weather, WritesARowForEveryStep) {
    const auto rows_of = [&](const char* name, std::vector<std::string> more) {
        std::vector<std::string> words = {"weather", at("cube.obj"), "-o",     at("worn.off"),
                                          "--csv",   at(name),       "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = test::scree(words);
        EXPECT_EQ(run.status, 0) << run.errors;
        std::vector<std::string> rows;
        std::istringstream text(bytes_of(name));
        for (std::string row; std::getline(text, row);)
            rows.push_back(row);
        return rows;
    };
    const auto rows = rows_of("steps.csv", {"--steps", "12", "--threads", "1"});
    ASSERT_EQ(rows.size(), 13U);
    EXPECT_THAT(rows[0], HasSubstr("step,step_limit,restarts,mean_edge_m"));
    const auto n_commas = std::count(rows[0].begin(), rows[0].end(), ',');
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_TRUE(rows[i].starts_with(std::to_string(i) + ",10,0,")) << rows[i];
        EXPECT_EQ(std::count(rows[i].begin(), rows[i].end(), ','), n_commas);
    }
    const auto timed = rows_of("timed.csv", {"--steps", "2", "--csv-times"});
    EXPECT_THAT(timed[0], HasSubstr(",step_ms,small_faces_ms,test_ms"));
    // Long steps are taken back; the rows of those go with them.
    const auto shorter = rows_of("short.csv", {"--steps", "6", "--step-limit", "0.3",
                                               "--check-every", "1", "--small-faces", "0"});
    for (std::size_t i = 1; i < shorter.size(); ++i)
        EXPECT_TRUE(shorter[i].starts_with(std::to_string(i) + ",")) << shorter[i];
    EXPECT_GT(shorter.size(), 7U);
}

TEST_F(Weather, RefusesACheckpointOfAnotherRun) {
    write_whole_file(at("run.state"), std::string_view("something"));
    const ProgramRun run = test::scree(
        {"weather", at("cube.obj"), "-o", at("worn.obj"), "--checkpoint", at("run.state")});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("it is no checkpoint of scree weather"));
    EXPECT_FALSE(fs::exists(at("worn.obj")));
}

TEST_F(Weather, RemovesItsCheckpointWhenItIsDone) {
    const ProgramRun run =
        test::scree({"weather", at("cube.obj"), "-o", at("worn.obj"), "--steps", "20",
                     "--checkpoint", at("run.state"), "--save-seconds", "0"});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_FALSE(fs::exists(at("run.state")));
}

TEST_F(Weather, SaysWhatItCleaned) {
    meshing::MeshFile file{test::cube(4), {}};
    file.mesh.triangles.push_back(file.mesh.triangles[5]);
    file.mesh.positions.emplace_back(9, 9, 9);
    meshing::write_mesh(at("odd.stl"), {test::cube(2), {}});
    meshing::write_mesh(at("odd.ply"), file);
    const ProgramRun run =
        test::scree({"weather", at("odd.ply"), "-o", at("worn.glb"), "--steps", "2"});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_THAT(run.output,
                HasSubstr("cleaned: 1 repeated triangle dropped, 1 unused vertex dropped"));
}

TEST_F(Weather, NamesWhatIsWrong) {
    EXPECT_THAT(test::scree({"weather", at("none.obj"), "-o", at("x.obj")}).errors,
                HasSubstr("none.obj"));
    EXPECT_THAT(test::scree({"weather", at("cube.obj"), "-o", at("x.fbx")}).errors,
                HasSubstr("its name must end in .obj, .ply, .off, .stl or .glb"));
    EXPECT_THAT(test::scree({"weather", at("cube.obj"), "-o", at("cube.obj")}).errors,
                HasSubstr("is the mesh itself"));
    EXPECT_THAT(
        test::scree({"weather", at("cube.obj"), "-o", at("x.obj"), "--csv", at("cube.obj")}).errors,
        HasSubstr("would take the place of a mesh"));
    EXPECT_THAT(
        test::scree({"weather", at("cube.obj"), "-o", at("x.obj"), "--power", "0.5"}).errors,
        HasSubstr("power is 0.5, must be in [1, 100]"));
    write_whole_file(at("points.obj"), std::string_view("v 0 0 0\nv 1 0 0\n"));
    EXPECT_THAT(test::scree({"weather", at("points.obj"), "-o", at("x.obj")}).errors,
                HasSubstr("it holds points alone"));
    write_whole_file(at("tiny.ply"),
                     std::string_view("ply\nformat binary_little_endian 1.0\nelement vertex "
                                      "180000000\nproperty float x\nproperty float y\n"
                                      "property float z\nend_header\n"));
    EXPECT_THAT(test::scree({"weather", at("tiny.ply"), "-o", at("x.obj")}).errors,
                HasSubstr("more than its bytes can hold"));
}

}  // namespace
}  // namespace scree
