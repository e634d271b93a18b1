#include "base/whole_file.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::files_below;
using test::ProgramRun;
using testing::HasSubstr;

constexpr const char* kScene = R"({"format": "scree-scene", "version": 1,
 "ground": {"width": 70, "height": 40, "cell_size_m": 0.02,
            "shapes": [{"kind": "hills", "height_m": 0.02, "length_m": 0.5}]},
 "materials": [{"id": 0, "name": "sand"},
               {"id": 1, "name": "mud", "repose_deg": 58, "mobility": 0.25, "diffusion": 0.05}],
 "regions": [{"material": "mud", "rect_m": [0.7, 0, 2, 2]}],
 "objects": [{"name": "ball", "mass_kg": 30, "drag_n": 50,
   "shape": {"kind": "sphere", "radius_m": 0.14},
   "motion": {"ride": "sink", "sink_m": 0.05, "rolling": {"radius_m": 0.14},
     "keys": [{"time_s": 0, "position_m": [0.2, 0.2, 0.4]},
              {"time_s": 0.4, "position_m": [1.2, 0.2, 0.4]}]}}],
 "frames": 12, "outputs": {"every": 4, "picture_width": 96, "picture_height": 60,
                           "preview_width": 48, "mesh_side": 30, "texture_side": 64}})";

// Times differ from run to run; nothing else may.
std::string without_times(const std::string& report) {
    json value = json::parse(report);
    for (json& frame : value["frames"])
        frame.erase("ms");
    value.erase("median_solve_ms");
    value.erase("seconds");
    return value.dump();
}

class Deform : public testing::Test {
protected:
    void SetUp() override { write(kScene); }
    void write(const std::string& text) {
        write_whole_file(dir_ / "s.json", std::string_view(text));
    }
    // The scene with one text in the place of another.
    void write_with(const std::string& from, const std::string& to) {
        std::string text = kScene;
        const auto at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        write(text.replace(at, from.size(), to));
    }
    ProgramRun deform(std::vector<std::string> more, const std::string& out = "out") {
        std::vector<std::string> words = {"deform", dir_ / "s.json", "-o", dir_ / out};
        words.insert(words.end(), more.begin(), more.end());
        return test::scree(words);
    }
    json report(const std::string& out = "out") {
        return json::parse(read_whole_file(dir_ / out / "report.json", 1 << 24));
    }

    test::TempDir dir_;
};

TEST_F(Deform, WritesTheGroundItsPicturesAndAReport) {
    const ProgramRun run = deform({});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_THAT(run.output, HasSubstr("s.json: 12 frames of 70 x 40 cells"));
    EXPECT_THAT(run.errors, HasSubstr("computed on"));
    const auto files = files_below(dir_ / "out");
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files)
        names.push_back(name);
    EXPECT_THAT(names,
                testing::UnorderedElementsAre("ddh.exr", "height.exr", "terrain.glb", "preview.gif",
                                              "report.json", "frames/0001.png", "frames/0005.png",
                                              "frames/0009.png", "frames/0012.png"));
    const vision::HeightImage moved = vision::read_heights(dir_ / "out" / "ddh.exr");
    EXPECT_EQ(moved.metres.width(), 70);
    EXPECT_EQ(moved.metres_per_pixel, 0.02);
    EXPECT_LT(moved.metres(30, 20), -0.01F);
    EXPECT_EQ(vision::read_photo(dir_ / "out/frames/0012.png").pixels.width(), 96);
    EXPECT_EQ(files.at("preview.gif").substr(0, 6), "GIF89a");
    EXPECT_EQ(vision::read_photo(dir_ / "out/preview.gif").pixels.width(), 48);
    EXPECT_EQ(test::scree({"check", dir_ / "out/terrain.glb"}).status, 0);
}

TEST_F(Deform, RocksOfTheSceneStandNearTheEye) {
    ASSERT_EQ(test::scree({"procedural", "-o", dir_ / "r.glb", "--seed", "3", "--quiet"}).status,
              0);
    const auto picture = [&](const std::string& near_m) {
        write_with(R"("frames": 12)",
                   R"("rocks": {"file": "r.glb", "near_m": )" + near_m + R"(}, "frames": 1)");
        const ProgramRun run = deform({"--quiet"}, "near" + near_m);
        EXPECT_EQ(run.status, 0) << run.errors;
        return vision::read_photo(dir_ / ("near" + near_m) / "frames/0001.png").pixels;
    };
    const Photo none = picture("0");
    const std::string renderer = report("near0")["renderer"];
    if (renderer.find("software (") == 0)
        GTEST_SKIP() << "no OpenGL: " << renderer;
    EXPECT_NE(picture("1000"), none);
}

TEST_F(Deform, ReportSaysWhatHappened) {
    ASSERT_EQ(deform({"--no-frames", "--quiet"}).status, 0);
    const json said = report();
    EXPECT_EQ(said["frames"].size(), 12U);
    EXPECT_TRUE(said["frames"][3]["ms"].contains("step"));
    EXPECT_GT(said["volume"]["before_m3"], 0.5);
    EXPECT_LT(std::abs(said["volume"]["relative_drift"].get<double>()), 1e-9);
    EXPECT_NEAR(said["volume"]["after_m3"], said["volume"]["before_m3"], 1e-9);
    EXPECT_EQ(said["materials"].size(), 2U);
    EXPECT_GT(said["materials"][1]["moved_m3"], 0.0);
    EXPECT_GT(said["materials"][0]["greatest_slope_deg"], 5.0);
    EXPECT_FALSE(said["device"].get<std::string>().empty());
    EXPECT_EQ(said["objects"][0]["smaller_than_cell"], false);
    EXPECT_GT(said["objects"][0]["unspent_force_n"], 0.0);  // cells that yield
    EXPECT_GE(said["objects"][0]["unspent_force_n"], said["frames"][5]["unspent_force_n"]);
    EXPECT_TRUE(said["settled"].is_null());
    EXPECT_FALSE(fs::exists(dir_ / "out/frames"));
    EXPECT_FALSE(fs::exists(dir_ / "out/preview.gif"));
}

TEST_F(Deform, SettlesWhereTheSceneAsks) {
    write_with("\"frames\": 12", "\"settle\": true, \"frames\": 12");
    const ProgramRun run = deform({});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_THAT(run.output, HasSubstr("settled "));
    const json said = report();
    EXPECT_GT(said["settled"]["moved_m3"], 0.0);
    EXPECT_LE(said["settled"]["excess"], 0.001);
    for (const json& material : said["materials"])
        EXPECT_LE(material["greatest_slope_deg"].get<double>(),
                  material["repose_deg"].get<double>() + 0.5);
    EXPECT_TRUE(fs::exists(dir_ / "out/settled.png"));
    ASSERT_EQ(deform({"--no-frames", "--quiet"}).status, 0);
    EXPECT_FALSE(fs::exists(dir_ / "out/settled.png"));
}

TEST_F(Deform, IsTheSameForAnyThreadCount) {
    for (const char* threads : {"1", "2"})
        ASSERT_EQ(deform({"--threads", threads, "--device", "cpu", "--quiet"}, threads).status, 0);
    const auto one = files_below(dir_ / "1");
    const auto two = files_below(dir_ / "2");
    ASSERT_EQ(one.size(), two.size());
    for (const auto& [name, bytes] : one) {
        if (name == "report.json")
            EXPECT_EQ(without_times(bytes), without_times(two.at(name)));
        else
            EXPECT_TRUE(bytes == two.at(name)) << name << " differs";
    }
}

TEST_F(Deform, AShorterRunLeavesNoPicturesOfALongerOne) {
    ASSERT_EQ(deform({"--quiet"}).status, 0);
    const ProgramRun run = deform({"--frames", "2", "--json", "--quiet"});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_EQ(json::parse(run.output)["frames"].size(), 2U);
    EXPECT_TRUE(fs::exists(dir_ / "out/frames/0002.png"));
    EXPECT_FALSE(fs::exists(dir_ / "out/frames/0005.png"));
}

TEST_F(Deform, BadScenesFailBeforeAnyWork) {
    struct Bad {
        const char* from;
        const char* to;
        const char* reason;
    };
    for (const Bad& bad :
         {Bad{"\"frames\": 12", "\"frame\": 12", "s.json: the file has the unknown member"},
          Bad{"\"frames\": 12", "\"frames\": NaN", "s.json is no JSON"},
          Bad{"\"width\": 70", "\"width\": 60000", "s.json: ground.width is 60000"},
          Bad{"\"diffusion\": 0.05", "\"diffusion\": -0.05", "s.json: materials[1].diffusion"},
          Bad{"\"diffusion\": 0.05", "\"diffusion\": 0.5", "beyond the stability bound"},
          Bad{"\"material\": \"mud\"", "\"material\": \"ice\"", "s.json: regions[0].material"},
          Bad{"\"kind\": \"sphere\", \"radius_m\": 0.14", "\"kind\": \"mesh\", \"file\": \"m.glb\"",
              "m.glb, which is no file"},
          Bad{"\"time_s\": 0.4", "\"time_s\": 0", "s.json: objects[0].motion"}}) {
        write_with(bad.from, bad.to);
        const ProgramRun run = deform({});
        EXPECT_EQ(run.status, 1) << bad.to;
        EXPECT_THAT(run.errors, HasSubstr(bad.reason));
        EXPECT_FALSE(fs::exists(dir_ / "out")) << bad.to;
    }
    EXPECT_EQ(deform({"--frames", "-1"}).status, 2);
    EXPECT_EQ(deform({"--device", "abacus"}).status, 2);
    EXPECT_EQ(test::scree({"deform", dir_ / "none.json", "-o", dir_ / "out"}).status, 1);
}

TEST_F(Deform, AnObjectOutsideTheGroundMovesNothing) {
    std::string text = kScene;
    for (const char* z : {"0.2, 0.4]}", "0.2, 0.4]}"})
        if (const auto at = text.find(z); at != std::string::npos)
            text.replace(at, std::string(z).size(), "0.2, -9]}");
    write(text);
    ASSERT_EQ(deform({"--no-frames", "--quiet"}).status, 0);
    EXPECT_EQ(report()["volume"]["moved_m3"], 0.0);
}

}  // namespace
}  // namespace scree
