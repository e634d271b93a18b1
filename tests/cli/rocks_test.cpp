#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::files_below;
using test::ProgramRun;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

constexpr const char* kFiles[] = {
    "rocks.json", "labels.png", "overlay.png",      "preview.png",      "rocks.glb",
    "lods.json",  "patch.glb",  "displacement.exr", "displacement.png", "normal.png",
    "ao.png",     "sizes.csv",  "sizes.png"};

// One run on one photograph, shared by the tests that look at its results.
class Rocks : public testing::Test {
protected:
    static void SetUpTestSuite() {
        dir_ = new test::TempDir;
        test::write_test_photo(*dir_ / "gravel.png", 360, 240);
        run_ = new ProgramRun(test::scree({"rocks", *dir_ / "gravel.png", "-o", *dir_ / "out",
                                           "--width-m", "0.72", "--json", "--threads", "2"}));
    }
    static void TearDownTestSuite() {
        delete run_;
        delete dir_;
    }
    static fs::path photo() { return *dir_ / "gravel.png"; }
    static fs::path out() { return *dir_ / "out"; }
    static fs::path other(const std::string& name) { return *dir_ / name; }

    static test::TempDir* dir_;
    static ProgramRun* run_;
};
test::TempDir* Rocks::dir_ = nullptr;
ProgramRun* Rocks::run_ = nullptr;

TEST_F(Rocks, WritesEveryFileAndSaysSo) {
    ASSERT_EQ(run_->status, 0) << run_->errors;
    const json report = json::parse(run_->output)["photographs"][0];
    std::vector<std::string> listed = report["files"];
    for (const char* name : kFiles)
        EXPECT_THAT(listed, testing::Contains(name));
    std::vector<std::string> found;
    for (const auto& [name, bytes] : files_below(out()))
        found.push_back(name);
    EXPECT_THAT(found, UnorderedElementsAreArray(listed));
    EXPECT_GT(report["rocks"], 10);
    EXPECT_EQ(report["sizes_by_number"]["unit"], "mm");
    EXPECT_GT(report["sizes_by_number"]["D84"], report["sizes_by_number"]["D16"]);
    const json split = report["split_percent"];
    EXPECT_NEAR(split["edges"].get<double>() + split["outlines"].get<double>() +
                    split["meshes"].get<double>(),
                100.0, 1e-6);
}

TEST_F(Rocks, FilesAgreeWithEachOther) {
    const vision::RockSet set = vision::read_rocks_json(out() / "rocks.json");
    EXPECT_EQ(set.image, "gravel.png");
    EXPECT_EQ(set.width, 360);
    EXPECT_NEAR(set.metres_per_pixel, 0.002, 1e-12);
    const LabelMap labels = vision::read_labels(out() / "labels.png");
    EXPECT_EQ(labels.width(), 360);
    EXPECT_EQ(*std::max_element(labels.begin(), labels.end()), set.rocks.size());
    for (const char* name : {"overlay.png", "normal.png", "ao.png"})
        EXPECT_EQ(vision::read_photo(out() / name).pixels.height(), 240) << name;
    const auto exr = vision::read_heights(out() / "displacement.exr");
    const auto png = vision::read_heights(out() / "displacement.png");
    EXPECT_NEAR(exr.metres_per_pixel, 0.002, 1e-9);
    const float top = *std::max_element(exr.metres.begin(), exr.metres.end());
    EXPECT_GT(top, 0.004F);
    for (std::size_t i = 0; i < exr.metres.size(); i += 97)
        ASSERT_NEAR(exr.metres.data()[i], png.metres.data()[i], top / 65000);
    for (const char* name : {"rocks.glb", "patch.glb", "lods/rocks_lod1.glb"})
        EXPECT_EQ(test::scree({"check", out() / name}).status, 0) << name;
}

TEST_F(Rocks, SameBytesForAnyThreadCount) {
    const ProgramRun one = test::scree(
        {"rocks", photo(), "-o", other("one"), "--width-m", "0.72", "--threads", "1", "--quiet"});
    ASSERT_EQ(one.status, 0) << one.errors;
    EXPECT_THAT(one.output, IsEmpty());
    EXPECT_THAT(one.errors, IsEmpty());
    const auto first = files_below(out());
    const auto second = files_below(other("one"));
    ASSERT_EQ(first.size(), second.size());
    for (const auto& [name, bytes] : first)
        EXPECT_TRUE(second.at(name) == bytes) << name << " differs";
}

TEST_F(Rocks, MeshBuildsTheSameFilesFromTheRocks) {
    const ProgramRun run =
        test::scree({"mesh", out() / "rocks.json", "-o", other("again"), "--photo", photo()});
    ASSERT_EQ(run.status, 0) << run.errors;
    const auto first = files_below(out());
    const auto second = files_below(other("again"));
    ASSERT_EQ(first.size(), second.size());
    // The edge field that sharpens the relief is not kept in rocks.json.
    const std::set<std::string> of_relief = {"displacement.exr", "displacement.png", "normal.png",
                                             "ao.png"};
    for (const auto& [name, bytes] : first)
        EXPECT_EQ(second.at(name) == bytes, of_relief.count(name) == 0) << name;
}

TEST_F(Rocks, WithoutDetailMeshBuildsTheSameMapsToo) {
    const ProgramRun rocks = test::scree(
        {"rocks", photo(), "-o", other("domes"), "--width-m", "0.72", "--detail", "0", "--quiet"});
    ASSERT_EQ(rocks.status, 0) << rocks.errors;
    const ProgramRun mesh = test::scree(
        {"mesh", out() / "rocks.json", "-o", other("plain"), "--photo", photo(), "--detail", "0"});
    ASSERT_EQ(mesh.status, 0) << mesh.errors;
    EXPECT_EQ(files_below(other("domes")), files_below(other("plain")));
    const auto domes = vision::read_heights(other("domes") / "displacement.exr").metres;
    const auto relief = vision::read_heights(out() / "displacement.exr").metres;
    EXPECT_EQ(*std::min_element(domes.begin(), domes.end()), 0.0F);
    EXPECT_LT(*std::min_element(relief.begin(), relief.end()), 0.0F);
}

TEST_F(Rocks, EditedRocksMakeFewerMeshes) {
    vision::RockSet set = vision::read_rocks_json(out() / "rocks.json");
    set.rocks.resize(3);
    vision::write_rocks_json(other("edited.json"), set);
    const ProgramRun run =
        test::scree({"mesh", other("edited.json"), "-o", other("edited"), "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output)["photographs"][0];
    EXPECT_EQ(report["rocks"], 3);
    EXPECT_THAT(report["left_out"][0].get<std::string>(), HasSubstr("overlay.png"));
    EXPECT_FALSE(fs::exists(other("edited") / "overlay.png"));
    EXPECT_TRUE(fs::exists(other("edited") / "rocks.glb"));
}

TEST_F(Rocks, FlagsReachTheFiles) {
    const ProgramRun run =
        test::scree({"rocks", photo(), "-o", other("flags"), "--no-refine", "--max-segments", "12",
                     "--quantise", "--msft-lod", "--plain-nodes", "--seed", "5", "--debug-stages",
                     "--min-size", "30", "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output)["photographs"][0];
    EXPECT_EQ(report["sizes_by_number"]["unit"], "px");
    EXPECT_GE(report["sizes_by_number"]["D16"], 30);
    const auto files = files_below(other("flags"));
    EXPECT_THAT(files.at("rocks.glb"), HasSubstr("MSFT_lod"));
    EXPECT_THAT(files.at("rocks.glb"), HasSubstr("KHR_mesh_quantization"));
    EXPECT_THAT(files.at("patch.glb"), testing::Not(HasSubstr("EXT_mesh_gpu_instancing")));
    EXPECT_TRUE(std::any_of(files.begin(), files.end(),
                            [](const auto& file) { return file.first.starts_with("stages/01_"); }));
}

TEST_F(Rocks, SpeaksToPeopleToo) {
    const ProgramRun run =
        test::scree({"rocks", photo(), "-o", other("spoken"), "--method", "thesis"});
    ASSERT_EQ(run.status, 0) << run.errors;
    for (const char* word : {"gravel.png: ", " rocks, D16 ", "edges ", "outlines ", "meshes "})
        EXPECT_THAT(run.output, HasSubstr(word));
    EXPECT_THAT(run.output, HasSubstr(other("spoken").string()));
    EXPECT_THAT(run.errors, HasSubstr("finding edges\n"));
}

TEST_F(Rocks, SeveralPhotographsGetAFolderEach) {
    fs::create_directories(other("elsewhere"));
    fs::copy_file(photo(), other("elsewhere") / "gravel.png");
    vision::write_png(other("gravel-2.png"), Photo(40, 30));
    vision::write_png(other("empty.png"), Photo(1, 1));
    fs::resize_file(other("empty.png"), 0);
    const ProgramRun run =
        test::scree({"rocks", photo(), other("empty.png"), other("elsewhere") / "gravel.png",
                     other("gravel-2.png"), "-o", other("many")});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("empty.png: the file is empty"));
    EXPECT_THAT(run.errors, HasSubstr("1 of 4 photographs failed"));
    const auto files = files_below(other("many"));
    for (const char* folder : {"gravel", "gravel-2", "gravel-3"})
        EXPECT_EQ(files.count(std::string(folder) + "/rocks.json"), 1U) << folder;
    EXPECT_FALSE(fs::exists(other("many") / "empty"));
    EXPECT_EQ(files.at("gravel/rocks.json"), files.at("gravel-3/rocks.json"));
}

TEST_F(Rocks, ABlankRunTakesStaleFilesAway) {
    fs::copy(out(), other("reused"), fs::copy_options::recursive);
    vision::write_png(other("blank.png"), Photo(50, 40, glm::u8vec3(90)));
    const ProgramRun run = test::scree({"rocks", other("blank.png"), "-o", other("reused")});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_THAT(run.output, HasSubstr("no rocks found"));
    EXPECT_FALSE(fs::exists(other("reused") / "rocks.glb"));
    EXPECT_FALSE(fs::exists(other("reused") / "lods"));
    EXPECT_TRUE(vision::read_rocks_json(other("reused") / "rocks.json").rocks.empty());
}

}  // namespace
}  // namespace scree
