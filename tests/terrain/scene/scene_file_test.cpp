#include "terrain/scene/scene_file.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"

#include <string>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kStart = R"("format": "scree-scene", "version": 1)";
constexpr const char* kGround = R"("ground": {"width": 20, "height": 10, "cell_size_m": 0.1})";

Scene parsed(const std::string& members) {
    return scene_from_json("{" + std::string(kStart) + ", " + members + "}", "s.json", "/at");
}

std::string with_ground(const std::string& members) {
    return std::string(kGround) + ", " + members;
}

TEST(SceneFile, LeavesDefaultsWhereNothingIsSaid) {
    const Scene scene = parsed(kGround);
    EXPECT_EQ(scene.ground.width, 20);
    EXPECT_EQ(scene.ground.height, 10);
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].soil, kSand);
    EXPECT_EQ(scene.frames, 100);
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_TRUE(scene.files.empty());
}

TEST(SceneFile, ReadsEveryPart) {
    const Scene scene = parsed(R"(
      "ground": {"heights": "dem/h.exr", "height_scale": 2, "cell_size_m": 0.5,
        "shapes": [{"kind": "pile", "centre_m": [1, 2], "height_m": 3, "slope_deg": 50}]},
      "materials": [{"id": 4, "name": "clay", "mobility": 0.3},
                    {"id": 7, "name": "grit", "textures": {"albedo": "grit.jpg", "size_m": 0.25}}],
      "regions": [{"material": "grit", "disc_m": [1, 2, 3], "ragged_m": 0.1},
                  {"material": "clay", "rect_m": [0, 1, 2, 3]},
                  {"material": "grit", "polygon_m": [[0, 0], [1, 0], [0, 1]]}],
      "bearing_kpa_per_m": {"grit": 900},
      "objects": [{"name": "wheel", "mass_kg": 12, "force_n": [1, 2, 3], "drag_n": 5,
        "shape": {"kind": "tyre", "radius_m": 0.4, "lugs": 30},
        "motion": {"ride": "weight", "rolling": {"radius_m": 0.4}, "from_s": 1, "to_s": 9,
          "keys": [{"time_s": 0, "position_m": [0, 1, 0], "rotation_deg": [0, 90, 0]},
                   {"time_s": 2, "position_m": [4, 1, 0], "quaternion": [0, 0, 0, 2],
                    "scale": 2}]}},
        {"shape": {"kind": "mesh", "file": "m.glb"},
         "motion": {"keys": [{"time_s": 0, "position_m": [0, 0, 0]}]}}],
      "deformer": {"slide": "weight", "time_step": 0.5, "keep_base": false},
      "contact": {"outward": "radial", "spread": 0.25},
      "frames": 7, "frame_rate": 50, "substeps": 3, "seed": 11,
      "camera": {"azimuth_deg": 5, "eye_m": [0, 1, 2], "target_m": [1, 0, 0]},
      "outputs": {"every": 2, "picture_width": 64})");
    EXPECT_EQ(scene.ground.heights, "/at/dem/h.exr");
    EXPECT_EQ(scene.ground.shapes[0].kind, GroundShape::Kind::Pile);
    EXPECT_EQ(scene.materials[1].id, 7);
    EXPECT_EQ(scene.regions[0].material, 7);
    EXPECT_EQ(scene.regions[1].polygon.size(), 4U);
    EXPECT_EQ(scene.bearing.at("grit"), 900);
    EXPECT_EQ(std::get<TyreShape>(scene.objects[0].shape).lugs, 30);
    const ObjectMotion& motion = scene.objects[0].motion;
    EXPECT_EQ(motion.ride, Ride::Weight);
    const glm::dvec3 ahead = motion.keys[0].pose.rotation * glm::dvec3(1, 0, 0);
    EXPECT_NEAR(ahead.z, -1, 1e-12);
    EXPECT_NEAR(motion.keys[1].pose.rotation.w, 1, 1e-12);
    EXPECT_EQ(std::get<MeshFile>(scene.objects[1].shape).file, "/at/m.glb");
    EXPECT_EQ(scene.deformer.slide, Slide::Weight);
    EXPECT_FALSE(scene.deformer.keep_base);
    EXPECT_EQ(scene.contact.outward, Outward::Radial);
    EXPECT_EQ(scene.frames, 7);
    EXPECT_EQ(scene.camera.eye_m->z, 2);
    EXPECT_EQ(scene.outputs.every, 2);
    EXPECT_EQ(scene.files.size(), 3U);
}

struct Wrong {
    const char* what;
    std::string members;
    std::string place;
    std::string reason;
};

class SceneFileErrors : public testing::TestWithParam<Wrong> {};

TEST_P(SceneFileErrors, NameFileAndPath) {
    EXPECT_THAT([] { parsed(GetParam().members); },
                testing::ThrowsMessage<InvalidInput>(
                    AllOf(HasSubstr("s.json: " + GetParam().place), HasSubstr(GetParam().reason))));
}

std::string object(const std::string& members) {
    return with_ground(R"("objects": [{)" + members + "}]");
}
const std::string kStill = R"("motion": {"keys": [{"time_s": 0, "position_m": [0, 0, 0]}]})";
const std::string kBall = R"("shape": {"kind": "sphere"})";

INSTANTIATE_TEST_SUITE_P(
    Wrongs, SceneFileErrors,
    testing::Values(
        Wrong{"no ground", R"("frames": 3)", "ground", "is missing"},
        Wrong{"unknown", with_ground(R"("colour": 1)"), "the file", "unknown member \"colour\""},
        Wrong{"type", with_ground(R"("frames": "many")"), "frames", "must be a whole number"},
        Wrong{"fraction", with_ground(R"("frames": 2.5)"), "frames", "must be a whole number"},
        Wrong{"range", with_ground(R"("frames": 0)"), "frames", "is 0, must be in [1"},
        Wrong{"huge", R"("ground": {"width": 60000, "height": 60000, "cell_size_m": 1})",
              "ground.width", "is 60000, must be in [2, 16384]"},
        Wrong{"diffusion", with_ground(R"("materials": [{"id": 0, "name": "a", "diffusion": -1}])"),
              "materials[0].diffusion", "is -1"},
        Wrong{"stability", with_ground(R"("materials": [{"id": 0, "name": "a", "diffusion": 0.2}],
                             "deformer": {"time_step": 2})"),
              "deformer.time_step", "beyond the stability bound 0.25"},
        Wrong{"gain", with_ground(R"("deformer": {"slide": "gain"})"), "deformer.time_step",
              "bound 0.125"},
        Wrong{"word", with_ground(R"("deformer": {"slide": "fast"})"), "deformer.slide",
              "must be one of excess, weight, gain"},
        Wrong{"id without a material",
              with_ground(R"("regions": [{"material": "ice", "disc_m": [0, 0, 1]}])"),
              "regions[0].material", "\"ice\""},
        Wrong{"two forms", with_ground(R"("regions": [{"material": "sand", "disc_m": [0, 0, 1],
                                          "rect_m": [0, 0, 1, 1]}])"),
              "regions[0]", "must have one of"},
        Wrong{"bearing", with_ground(R"("bearing_kpa_per_m": {"ice": 4})"), "bearing_kpa_per_m",
              "\"ice\""},
        Wrong{"shape", object(R"("shape": {"kind": "cube"}, )" + kStill), "objects[0].shape.kind",
              "must be one of sphere"},
        Wrong{"radius", object(R"("shape": {"kind": "sphere", "radius_m": -1}, )" + kStill),
              "objects[0].shape.radius_m", "is -1"},
        Wrong{"other member", object(R"("shape": {"kind": "sphere", "lugs": 3}, )" + kStill),
              "objects[0].shape", "unknown member \"lugs\""},
        Wrong{"no motion", object(kBall), "objects[0].motion", "is missing"},
        Wrong{"no key", object(kBall + R"(, "motion": {"keys": []})"), "objects[0].motion",
              "has no key"},
        Wrong{"time runs back",
              object(kBall + R"(, "motion": {"keys": [{"time_s": 1, "position_m": [0, 0, 0]},
                                                      {"time_s": 1, "position_m": [0, 0, 0]}]})"),
              "objects[0].motion", "key 1 is at 1 s"},
        Wrong{"scale",
              object(kBall + R"(, "motion": {"keys": [{"time_s": 1, "position_m": [0, 0, 0],
                                                       "scale": 0}]})"),
              "objects[0].motion.keys[0].scale", "is 0"},
        Wrong{"triple", object(kBall + R"(, "motion": {"keys": [{"time_s": 1,
                                                               "position_m": [0, 0]}]})"),
              "objects[0].motion.keys[0].position_m", "must have 3 entries"},
        Wrong{"mass", object(kBall + R"(, "mass_kg": -3, )" + kStill), "objects[0].mass_kg",
              "is -3"},
        Wrong{"eye", with_ground(R"("camera": {"eye_m": [0, 0, 0]})"), "camera", "both"},
        Wrong{"settle literal",
              with_ground(R"("deformer": {"reading": "literal"}, "settle": true)"), "settle",
              "literal reading has no rest"},
        Wrong{"settle zero border",
              with_ground(R"("deformer": {"border": "zero"}, "settle": true)"), "settle",
              "take border no-flux"},
        Wrong{"rocks nowhere", with_ground(R"("rocks": {"near_m": 1})"), "rocks.file",
              "is missing"},
        Wrong{"twice", with_ground(R"("map": "m.json", "materials": [])"), "map",
              "stands beside materials"}),
    [](const auto& wrong) {
        std::string name;
        for (const char c : std::string(wrong.param.what))
            name += c == ' ' ? '_' : c;
        return name;
    });

TEST(SceneFileErrors, NoJsonNoFormatNoFile) {
    EXPECT_THAT([] { scene_from_json("{\"a\": nan}", "s.json", ""); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("s.json is no JSON")));
    EXPECT_THAT([] { scene_from_json(R"({"format": "x", "version": 1})", "s.json", ""); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("s.json: format")));
    EXPECT_THROW(scene_from_json(std::string(kMaxSceneBytes + 1, ' '), "s", ""), InvalidInput);
    const test::TempDir dir;
    EXPECT_THROW(read_scene(dir / "none.json"), IoError);
    write_whole_file(dir / "s.json",
                     "{" + std::string(kStart) + ", " +
                         object(R"("shape": {"kind": "mesh", "file": "no.glb"}, )" + kStill) + "}");
    EXPECT_THAT(
        [&] { read_scene(dir / "s.json"); },
        testing::ThrowsMessage<InvalidInput>(AllOf(HasSubstr("s.json: objects[0].shape.file names"),
                                                   HasSubstr("no.glb, which is no file"))));
}

TEST(SceneFile, TheScenesThatShipAreSound) {
    for (const char* name : {"sand", "mud", "pebbles", "three_materials"}) {
        const Scene scene =
            read_scene(std::string(SCREE_SOURCE_DIR) + "/testdata/scenes/" + name + ".json");
        EXPECT_EQ(scene.ground.width, 512) << name;
        EXPECT_FALSE(scene.objects.empty()) << name;
    }
}

}  // namespace
}  // namespace scree::terrain
