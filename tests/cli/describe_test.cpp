#include "base/whole_file.h"
#include "terrain/material/map_files.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view kTable = R"({"format": "scree-materials", "version": 1,
 "cell_size": 0.25, "materials": [
  {"id": 0, "name": "sand", "colour": [214, 186, 130]},
  {"id": 1, "name": "mud", "repose_deg": 15, "mobility": 0.25, "diffusion": 0.08,
   "colour": [92, 70, 50]}]})";

constexpr std::string_view kStrokes = R"({"format": "scree-strokes", "version": 1, "size": [24, 16],
 "cell_size": 0.25, "ground": "sand", "strokes": [
  {"op": "brush", "points": [[1, 1], [5, 3]], "radius": 1, "hardness": 0.5, "material": "mud"},
  {"op": "fill", "at": [0, 0], "material": "mud"}, {"op": "undo"}]})";

class Describe : public testing::Test {
protected:
    Describe() {
        write_whole_file(at("table.json"), kTable);
        write_whole_file(at("strokes.json"), kStrokes);
    }

    fs::path at(const std::string& name) const { return dir_ / name; }

    test::ProgramRun describe(std::vector<std::string> words, const std::string& out) const {
        words.insert(words.begin(), "describe");
        words.insert(words.end(), {"-o", at(out)});
        return test::scree(words);
    }

    // Refused with a sentence; nothing is left behind.
    void expect_refused(const std::vector<std::string>& words, int status,
                        const std::string& reason) const {
        const test::ProgramRun run = describe(words, "refused");
        EXPECT_EQ(run.status, status) << run.errors;
        EXPECT_THAT(run.errors, AllOf(StartsWith("scree describe: "), HasSubstr(reason)));
        EXPECT_THAT(run.output, IsEmpty());
        EXPECT_FALSE(fs::exists(at("refused"))) << reason;
    }

    test::TempDir dir_;
};

TEST_F(Describe, StrokesBecomeAMapInBothFormsAndComeBack) {
    const auto run = describe({"--strokes", at("strokes.json"), "--materials", at("table.json"),
                               "--export", "rgba16", "--bake", "48", "--channels", "--json"},
                              "one");
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_EQ(report["cells"], json({24, 16}));
    EXPECT_NEAR(report["rgba16"]["repose_deg"].get<double>(), 0.0, 1e-3);
    const auto files = test::files_below(at("one"));
    EXPECT_EQ(files.size(), 14U);
    for (const json& name : report["files"])
        EXPECT_EQ(files.count(name.get<std::string>()), 1U) << name;
    const terrain::DescriptionMap map = terrain::read_description_map(at("one"));
    EXPECT_EQ(map.ids(8, 8), 1);
    EXPECT_EQ(map.ids(0, 15), 0);
    EXPECT_FALSE(map.repose.empty());
    EXPECT_EQ(vision::read_photo(at("one") / "ground_albedo.png").pixels.width(), 48);

    const auto again = describe({"--import", at("one") / "map_rgba.png", "--id-file",
                                 at("one") / "map_ids.txt", "--export", "rgba16"},
                                "two");
    ASSERT_EQ(again.status, 0) << again.errors;
    EXPECT_THAT(again.output, HasSubstr("import: nothing was lost"));
    const auto copies = test::files_below(at("two"));
    for (const char* name : {"ids.png", "map_rgba.png", "map_ids.txt"})
        EXPECT_EQ(files.at(name), copies.at(name)) << name;
}

TEST_F(Describe, WritesTheSameBytesAgainAndTakesOldFilesAway) {
    const std::vector<std::string> words = {"--strokes", at("strokes.json"), "--materials",
                                            at("table.json")};
    auto more = words;
    more.insert(more.end(), {"--shaders", "--bake", "8"});
    ASSERT_EQ(describe(more, "one").status, 0);
    const auto before = test::files_below(at("one"));
    ASSERT_EQ(describe(words, "one").status, 0);
    const auto after = test::files_below(at("one"));
    EXPECT_EQ(after.size(), 4U);
    for (const auto& [name, bytes] : after)
        EXPECT_EQ(bytes, before.at(name)) << name;
}

// Row DM-08 by the command: two layers mix, parameters lie between, every material's mass is kept.
TEST_F(Describe, LayersMixWithWhatLiesBelow) {
    write_whole_file(at("layers.json"), std::string_view(R"({"format": "scree-layers", "version": 1,
        "layers": [{"thickness_m": 0.1}, {"thickness_m": 0.3, "material": "mud"},
                   {"thickness_m": 0.2, "map": "plain"}]})"));
    const std::vector<std::string> strokes = {"--strokes", at("strokes.json"), "--materials",
                                              at("table.json")};
    ASSERT_EQ(describe(strokes, "plain").status, 0);
    auto words = strokes;
    words.insert(words.end(), {"--layers", at("layers.json"), "--mix-steps", "20",
                               "--mix-downwards", "0.1", "--mix-sideways", "0", "--json"});
    const auto run = describe(words, "mixed");
    ASSERT_EQ(run.status, 0) << run.errors;
    const json mixed = json::parse(run.output)["mixed"];
    EXPECT_EQ(mixed["layers"], 3);
    double whole = 0.0;
    for (std::size_t m = 0; m < 2; ++m) {
        EXPECT_NEAR(mixed["after_m3"][m].get<double>(), mixed["before_m3"][m].get<double>(), 1e-9);
        whole += mixed["after_m3"][m].get<double>();
    }
    EXPECT_NEAR(whole, 24 * 16 * 0.25 * 0.25 * 0.6, 1e-9);
    const terrain::DescriptionMap map = terrain::read_description_map(at("mixed"));
    const float sand = 34.0F * 0.0174533F;
    const float mud = 15.0F * 0.0174533F;
    EXPECT_LT(map.repose(0, 15), sand - 0.05F);  // sand over mud
    EXPECT_GT(map.repose(0, 15), mud + 0.01F);
    const auto planes = vision::read_planes(at("mixed") / "layers.exr");
    ASSERT_EQ(planes.size(), 6U);
    EXPECT_EQ(planes[0].name, "0.mud");
    EXPECT_GT(planes[0].values(0, 15), 0.02F);
    EXPECT_EQ(planes[1].name, "0.sand");
    EXPECT_NEAR(planes[0].values(0, 15) + planes[1].values(0, 15), 0.1F, 1e-6F);
    auto alone = strokes;
    alone.insert(alone.end(), {"--mix-downwards", "0.1"});
    expect_refused(alone, 2, "--mix-downwards needs --layers");
    write_whole_file(at("layers.json"), std::string_view(R"({"format": "scree-layers", "version": 1,
        "layers": [{"thickness_m": 0.1}, {"thickness_m": 0.3, "material": "ice"}]})"));
    expect_refused(words, 1, "layers.json: layers[1].material");
}

TEST_F(Describe, PaintedPicturesAndStrokesOverThem) {
    Photo painted(6, 4, glm::u8vec3(214, 186, 130));
    painted(2, 1) = {92, 70, 50};
    vision::write_png(at("painted.png"), painted);
    write_whole_file(at("over.json"), std::string_view(R"({"format": "scree-strokes", "version": 1,
        "strokes": [{"op": "fill", "at": [0.1, 0.1], "material": "mud"}]})"));
    const std::vector<std::string> words = {"--ids", at("painted.png"), "--materials",
                                            at("table.json")};
    const auto run = describe(words, "one");
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_THAT(run.output, AllOf(HasSubstr("6 x 4 cells of 0.25 m"), HasSubstr("4.2 %  mud")));
    EXPECT_EQ(terrain::read_description_map(at("one")).ids(2, 1), 1);
    const auto over = describe({"--map", at("one"), "--strokes", at("over.json")}, "two");
    ASSERT_EQ(over.status, 0) << over.errors;
    for (const std::uint8_t id : terrain::read_description_map(at("two")).ids)
        EXPECT_EQ(id, 1);
}

TEST_F(Describe, RocksAndTheGroundBetweenThem) {
    test::write_test_photo(at("photo.png"), 64, 48);
    LabelMap labels(64, 48);
    for (int y = 8; y < 24; ++y)
        for (int x = 16; x < 40; ++x)
            labels(x, y) = 1;
    vision::write_labels(at("labels.png"), labels);
    const auto run = describe({"--labels", at("labels.png"), "--photo", at("photo.png"),
                               "--width-m", "0.64", "--bake", "32"},
                              "one");
    ASSERT_EQ(run.status, 0) << run.errors;
    const terrain::DescriptionMap map = terrain::read_description_map(at("one"));
    EXPECT_EQ(map.ids.width(), 8);
    EXPECT_DOUBLE_EQ(map.cell_size, 0.08);
    EXPECT_EQ(map.ids(2, 1), 1);
    EXPECT_EQ(map.ids(6, 4), 0);
    EXPECT_TRUE(map.materials[1].gravel);
    EXPECT_EQ(vision::read_photo(map.materials[1].textures.albedo).pixels.width(), 48);
    EXPECT_DOUBLE_EQ(map.materials[1].textures.size_m, 0.48);
    EXPECT_TRUE(map.materials[1].textures.displacement.empty());

    // The depth map of the rocks goes with the photograph; found at 5 mm a pixel, used at 10.
    vision::HeightImage relief{FloatRaster(64, 48), 0.005};
    relief.metres(8 + 3, 7) = 0.02F;
    vision::write_heights_exr(at("relief.exr"), relief);
    std::vector<std::string> words = {"--labels",  at("labels.png"), "--photo",  at("photo.png"),
                                      "--width-m", "0.64",           "--relief", at("relief.exr")};
    const auto raised = describe(words, "two");
    ASSERT_EQ(raised.status, 0) << raised.errors;
    for (const auto& material : terrain::read_description_map(at("two")).materials) {
        const auto heights = vision::read_heights(material.textures.displacement);
        EXPECT_EQ(heights.metres.width(), 48);
        EXPECT_FLOAT_EQ(heights.metres(3, 7), 0.04F);
        EXPECT_DOUBLE_EQ(heights.metres_per_pixel, 0.01);
    }
    vision::write_heights_exr(at("relief.exr"), {FloatRaster(9, 9), 0.005});
    expect_refused(words, 1, "relief.exr has 9 x 9 pixels");
    expect_refused({"--strokes", at("strokes.json"), "--materials", at("table.json"), "--relief",
                    at("relief.exr")},
                   2, "--relief needs --labels");
}

TEST_F(Describe, RulesOverHeights) {
    vision::HeightImage heights{FloatRaster(10, 6), 0.5};
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 10; ++x)
            heights.metres(x, y) = static_cast<float>(x);
    vision::write_heights_exr(at("h.exr"), heights);
    write_whole_file(at("rules.json"), std::string_view(R"({"format": "scree-rules", "version": 1,
        "rules": [{"material": "mud", "height": {"max": 4.5}}], "otherwise": "sand"})"));
    const auto run = describe(
        {"--rules", at("rules.json"), "--heights", at("h.exr"), "--materials", at("table.json")},
        "one");
    ASSERT_EQ(run.status, 0) << run.errors;
    const terrain::DescriptionMap map = terrain::read_description_map(at("one"));
    EXPECT_EQ(map.cell_size, 0.5);
    for (int x = 0; x < 10; ++x)
        EXPECT_EQ(map.ids(x, 3), x <= 4 ? 1 : 0);
}

TEST_F(Describe, BadInputIsRefusedBeforeAnythingIsWritten) {
    const std::string table = at("table.json"), strokes = at("strokes.json");
    expect_refused({}, 2, "one of --map, --ids");
    expect_refused({"--photo", strokes, "--map", table}, 2, "--photo needs --labels");
    expect_refused({"--map", table, "--ids", table, "--materials", table}, 2, "one of --map");
    expect_refused({"--strokes", strokes, "--materials", table, "--cell-size-m", "2"}, 2,
                   "does not go with a script's own ground");
    expect_refused({"--map", table}, 1, "a table of materials alone");
    expect_refused({"--strokes", strokes, "--materials", strokes}, 1, "strokes.json: format is");
    vision::write_png(at("ids.png"), Raster<std::uint8_t>(3, 2, std::uint8_t{9}));
    expect_refused({"--ids", at("ids.png"), "--materials", table}, 1,
                   "cell (0, 0) has the id 9, which has no material");
    expect_refused({"--import", at("ids.png"), "--id-file", table}, 1, "ids.png has 1 channels");
    vision::write_png(at("grey.png"), Raster<std::uint8_t>(3, 2));
    expect_refused({"--rules", table, "--heights", at("grey.png"), "--materials", table}, 1,
                   "grey.png does not say its heights in metres");
    expect_refused({"--strokes", strokes, "--materials", table, "--bake", "99999"}, 2,
                   "bake is 99999");
}

TEST_F(Describe, NeverOverwritesItsInputNorTakesItAway) {
    const std::vector<std::string> words = {"--strokes",      at("strokes.json"), "--materials",
                                            at("table.json"), "--export",         "rgba8"};
    ASSERT_EQ(describe(words, "one").status, 0);
    const auto before = test::files_below(at("one"));
    const auto run = describe({"--map", at("one")}, "one");
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("would overwrite"));
    EXPECT_EQ(test::files_below(at("one")), before);
    fs::create_directories(at("two"));
    for (const char* name : {"map_rgba.png", "map_ids.txt"})
        fs::copy_file(at("one") / name, at("two") / name);
    const auto import = describe(
        {"--import", at("two") / "map_rgba.png", "--id-file", at("two") / "map_ids.txt"}, "two");
    ASSERT_EQ(import.status, 0) << import.errors;
    for (const char* name : {"map_rgba.png", "map_ids.txt"})
        EXPECT_EQ(test::files_below(at("two")).at(name), before.at(name)) << name;
}

}  // namespace
}  // namespace scree
