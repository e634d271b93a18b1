#include "base/whole_file.h"
#include "testdata/synthetic_photo.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::files_below;
using test::ProgramRun;
using testing::HasSubstr;

// True rocks of a made-up photograph, as files.
class Mesh : public testing::Test {
protected:
    static void SetUpTestSuite() {
        dir_ = new test::TempDir;
        const auto made = test::make_synthetic_photo(
            {.width = 300, .height = 200, .n_rocks = 40, .greatest_diameter = 70});
        vision::RockSet set{.image = "made.png",
                            .width = 300,
                            .height = 200,
                            .metres_per_pixel = 0.001,
                            .method = "truth",
                            .rocks = {}};
        for (const vision::Outline& outline : made.outlines) {
            const float depth = *std::min_element(outline.radii.begin(), outline.radii.end());
            set.rocks.push_back({outline, depth, 0.0F});
        }
        vision::write_png(*dir_ / "made.png", made.photo);
        vision::write_rocks_json(*dir_ / "made.json", set);
    }
    static void TearDownTestSuite() { delete dir_; }
    static fs::path at(const std::string& name) { return *dir_ / name; }

    static test::TempDir* dir_;
};
test::TempDir* Mesh::dir_ = nullptr;

TEST_F(Mesh, WritesAllFilesTheSameForAnyThreadCount) {
    for (const char* threads : {"1", "2"}) {
        const ProgramRun run = test::scree({"mesh", at("made.json"), "-o", at(threads), "--photo",
                                            at("made.png"), "--threads", threads, "--json"});
        ASSERT_EQ(run.status, 0) << run.errors;
        const json report = json::parse(run.output)["photographs"][0];
        EXPECT_EQ(files_below(at(threads)).size(), report["files"].size());
        EXPECT_TRUE(report["left_out"].empty());
    }
    const auto first = files_below(at("1"));
    for (const auto& [name, bytes] : files_below(at("2")))
        EXPECT_TRUE(first.at(name) == bytes) << name << " differs";
    EXPECT_EQ(first.at("rocks.json"), read_whole_file(at("made.json"), 1 << 24));
    EXPECT_THAT(first.at("patch.glb"), HasSubstr("EXT_mesh_gpu_instancing"));
    EXPECT_EQ(json::parse(first.at("lods.json"))["levels"][0]["file"], "rocks.glb");
}

TEST_F(Mesh, ScatterCoversGroundAndTakesTheGrid) {
    const ProgramRun free =
        test::scree({"scatter", at("made.json"), "-o", at("free.glb"), "--count", "150", "--json"});
    ASSERT_EQ(free.status, 0) << free.errors;
    const json report = json::parse(free.output);
    EXPECT_EQ(report["stones"], 150);
    EXPECT_GT(report["coverage"], 0.3);
    const ProgramRun grid = test::scree({"scatter", at("made.json"), "-o", at("grid.glb"), "--grid",
                                         "3", "--photo", at("made.png"), "--plain-nodes"});
    ASSERT_EQ(grid.status, 0) << grid.errors;
    const ProgramRun check = test::scree({"check", at("free.glb"), at("grid.glb")});
    EXPECT_EQ(check.status, 0) << check.output;
    EXPECT_THAT(check.output, HasSubstr("free.glb: sound"));
}

TEST_F(Mesh, ProceduralRocksNeedNoPhotograph) {
    const ProgramRun run = test::scree({"procedural", "-o", at("p.glb"), "--picture", at("p.png"),
                                        "--count", "5", "--segments", "24", "--seed", "11"});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_EQ(test::scree({"check", at("p.glb")}).status, 0);
    EXPECT_THAT(read_whole_file(at("p.glb"), 1 << 24), HasSubstr("rock_seed_15"));
    EXPECT_EQ(vision::read_photo(at("p.png")).pixels.width(), 900);
    const std::string bytes = read_whole_file(at("p.glb"), 1 << 24);
    ASSERT_EQ(test::scree({"procedural", "-o", at("p.glb"), "--count", "5", "--segments", "24",
                           "--seed", "11", "--threads", "1"})
                  .status,
              0);
    EXPECT_TRUE(read_whole_file(at("p.glb"), 1 << 24) == bytes);
}

TEST_F(Mesh, CheckFindsWhatIsWrong) {
    ASSERT_EQ(
        test::scree({"scatter", at("made.json"), "-o", at("good.glb"), "--count", "50"}).status, 0);
    std::string bytes = read_whole_file(at("good.glb"), 1 << 26);
    const auto place = bytes.find("\"ROTATION\"");
    ASSERT_NE(place, std::string::npos);
    bytes.replace(place, 10, "\"ROTATION_");
    write_whole_file(at("bad.glb"), std::string_view(bytes));
    const ProgramRun run = test::scree({"check", at("bad.glb"), "--json"});
    EXPECT_EQ(run.status, 1);
    EXPECT_FALSE(json::parse(run.output).begin()->empty());
    EXPECT_THAT(run.errors, HasSubstr("scree check: "));
    EXPECT_EQ(test::scree({"check", at("missing.glb")}).status, 1);
}

TEST_F(Mesh, RefusesAPhotographOfAnotherSize) {
    vision::write_png(at("other.png"), Photo(30, 20));
    const ProgramRun run =
        test::scree({"mesh", at("made.json"), "-o", at("none"), "--photo", at("other.png")});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("30 x 20"));
    EXPECT_FALSE(fs::exists(at("none")));
}

}  // namespace
}  // namespace scree
