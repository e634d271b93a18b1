#include "base/whole_file.h"
#include "meshing/io/mesh_io.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/las_file.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramRun;
using testing::HasSubstr;

class Terrain : public testing::Test {
protected:
    Terrain() {
        vision::HeightImage heights{FloatRaster(60, 40, 5.0F), 0.5};
        vision::write_heights_exr(at("flat.exr"), heights);
        write_whole_file(at("bed.json"), std::string_view(R"({"format": "scree-beds",
            "version": 1, "beds": [{"line": [[0, 10], [30, 10]], "width": 3, "depth": 2,
            "bank": 2}]})"));
    }
    fs::path at(const std::string& name) const { return dir_ / name; }
    ProgramRun terrain(const std::string& input, std::vector<std::string> more = {}) const {
        std::vector<std::string> words = {"terrain", at(input), "-o", at("mesh.ply")};
        words.insert(words.end(), more.begin(), more.end());
        return test::scree(words);
    }
    meshing::TriMesh mesh() const { return meshing::read_mesh(at("mesh.ply")).mesh; }

private:
    test::TempDir dir_;
};

TEST_F(Terrain, CutsABedIntoAHeightMap) {
    const ProgramRun run = terrain("flat.exr", {"--vertices", "700", "--bed", at("bed.json"),
                                                "--picture", at("mesh.png"), "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_EQ(report["vertices"], 700);
    EXPECT_NEAR(report["beds"][0]["deepest_m"].get<double>(), 2.0, 1e-5);
    const meshing::TriMesh made = mesh();
    ASSERT_EQ(made.positions.size(), 700U);
    const auto [low, high] =
        std::minmax_element(made.positions.begin(), made.positions.end(),
                            [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; });
    EXPECT_NEAR(low->y, 3.0F, 1e-4F);
    EXPECT_NEAR(low->z, 10.0F, 1.6F);
    EXPECT_EQ(high->y, 5.0F);
    EXPECT_GT(vision::read_photo(at("mesh.png")).pixels.width(), 100);
}

TEST_F(Terrain, MovesASurveyToTheOriginAndItsBedsToo) {
    std::vector<glm::dvec3> points;
    for (int y = 0; y <= 40; ++y)
        for (int x = 0; x <= 60; ++x)
            points.emplace_back(612000.0 + 0.5 * x, 5512000.0 + 0.5 * y, 80.0);
    write_whole_file(at("survey.las"), std::string_view(test::las_file(
                                           points, std::vector<std::uint8_t>(points.size(), 2),
                                           {.offset = {612000, 5512000, 0}})));
    // Five metres south of the northern edge: z = 5.
    write_whole_file(at("east.json"), std::string_view(R"({"format": "scree-beds", "version": 1,
        "beds": [{"line": [[611990, 5512015], [612050, 5512015]], "width": 2, "depth": 1,
        "bank": 1}]})"));
    const ProgramRun run =
        terrain("survey.las", {"--vertices", "500", "--bed", at("east.json"), "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_EQ(report["survey"]["points"], 61 * 41);
    EXPECT_EQ(report["survey"]["moved_m"], json({612000.0, -5512020.0}));
    for (const glm::vec3& p : mesh().positions) {
        EXPECT_TRUE(p.x >= 0.0F && p.x <= 30.0F && p.z >= 0.0F && p.z <= 20.0F);
        const float d = std::abs(p.z - 5.0F);
        EXPECT_NEAR(p.y, d <= 1.0F ? 79.0F : d <= 2.0F ? 78.0F + d : 80.0F, 2e-3F);
    }
}

TEST_F(Terrain, GivesTheSameBytesForAnyNumberOfThreads) {
    std::string bytes[2];
    for (const int threads : {1, 2}) {
        const ProgramRun run = terrain("flat.exr", {"--vertices", "400", "--bed", at("bed.json"),
                                                    "--threads", std::to_string(threads)});
        ASSERT_EQ(run.status, 0) << run.errors;
        bytes[threads - 1] = read_whole_file(at("mesh.ply"), 1 << 20);
    }
    EXPECT_EQ(bytes[0], bytes[1]);
}

TEST_F(Terrain, SaysWhatIsWrong) {
    write_whole_file(at("bad.las"), std::string_view("LASF"));
    EXPECT_THAT(terrain("bad.las", {"--width-m", "5"}).errors, HasSubstr("leave --width-m"));
    write_whole_file(at("far.json"), std::string_view(R"({"format": "scree-beds", "version": 1,
        "beds": [{"line": [[900, 10], [930, 10]]}]})"));
    const ProgramRun far = terrain("flat.exr", {"--bed", at("far.json")});
    EXPECT_EQ(far.status, 1);
    EXPECT_THAT(far.errors, HasSubstr("lies nowhere over the ground"));
    EXPECT_EQ(terrain("flat.exr", {"--vertices", "1"}).status, 2);
    EXPECT_FALSE(fs::exists(at("mesh.ply")));
}

}  // namespace
}  // namespace scree
