#include "terrain/surface/erosion_scene.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::erosion_scene_from_json;
using terrain::ErosionScene;
using terrain::GroundOptions;
using terrain::GroundShape;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A whole scene with one member replaced.
std::string scene(const std::string& fluid, const std::string& rest = "") {
    return R"({"format": "scree-erosion", "version": 1,
               "mesh": {"ground": {"shape": "canyon", "edge": 0.2}}, "fluid": )" +
           fluid + rest + "}";
}

constexpr const char* kWater = R"({"kind": "particles", "radius": 0.1, "gravity": [0, -3.7, 0],
  "domain": {"low": [-3, -1, -2], "high": [3, 4, 2]},
  "sources": [{"centre": [-1, 0.5, 0], "velocity": [1, 0, 0], "radius": 0.3, "start": 1, "end": 2}],
  "rains": [{"centre": [0, 2, 0], "width": 1, "depth": 2, "rate": 50}],
  "pools": [{"low": [0, 0.3, 0], "high": [0.5, 0.6, 0.5]}],
  "sinks": [{"low": [1, 0, 0], "high": [2, 1, 1]}]})";
constexpr const char* kStream =
    R"({"kind": "scripted", "radius": 0.05, "streams": [{"above_bed": 0.1, "speed": 2}]})";

TEST(ErosionScene, ReadsEveryPart) {
    const ErosionScene s = erosion_scene_from_json(
        scene(kWater, R"(, "run": {"steps": 7, "scheme": "sediment", "check_every": 2},
                "wear": {"influence": 3, "range": "symmetric", "rim": "free"},
                "sediment": {"critical": 9, "shear": "full"}, "output": {"morph": false})"),
        "s.json");
    EXPECT_EQ(s.ground.shape, GroundShape::Canyon);
    EXPECT_EQ(s.water.gravity.y, -3.7F);
    EXPECT_EQ(s.water.options.radius, 0.1);
    EXPECT_EQ(s.water.emitters.sources.at(0).end, 2.0);
    EXPECT_EQ(s.water.emitters.rains.at(0).rate, 50.0);
    EXPECT_EQ(s.water.emitters.pools.size(), 1U);
    EXPECT_EQ(s.water.emitters.sinks.at(0).high.x, 2.0F);
    EXPECT_EQ(s.run.steps, 7);
    EXPECT_EQ(s.run.scheme, terrain::ErosionScheme::Sediment);
    EXPECT_EQ(s.wear.range, meshing::UnsignedScale::Symmetric);
    EXPECT_EQ(s.wear.rim, meshing::RimPolicy::Free);
    EXPECT_EQ(s.sediment.shear, terrain::ShearVelocity::Full);
    EXPECT_FALSE(s.output.morph);
    EXPECT_EQ(terrain::make_fluid(s)->state().radius, 0.1);
    const ErosionScene scripted = erosion_scene_from_json(scene(kStream), "s.json");
    EXPECT_GT(terrain::make_fluid(scripted)->state().size(), 10U);
}

TEST(ErosionScene, ReadsTheExamples) {
    for (const char* name : {"erode_canyon.json", "erode_bend.json"}) {
        const std::filesystem::path path =
            std::filesystem::path(SCREE_SOURCE_DIR) / "testdata" / "scenes" / name;
        const ErosionScene s = erosion_scene_from_json(read_whole_file(path, 1 << 20), name);
        EXPECT_NO_THROW(terrain::make_fluid(s)->set_mesh(terrain::make_ground(s.ground)));
    }
}

struct BadScene {
    std::string text;
    const char* message;
};

TEST(ErosionScene, NamesThePlaceOfEveryFault) {
    const BadScene cases[] = {
        {"", "s.json is no JSON"},
        {"[1, 2", "s.json is no JSON"},
        {"[]", "s.json: the file is of type array, must be an object"},
        {"{}", "s.json: format is missing"},
        {R"({"format": "x", "version": 1})", R"(s.json: format is "x", must be "scree-erosion")"},
        {R"({"format": "scree-erosion", "version": 2})", "s.json: version is 2, must be in [1, 1]"},
        {scene("3"), "s.json: fluid is of type number, must be an object"},
        {scene(R"({"kind": "gas"})"), R"(fluid.kind is "gas", must be one of particles, scripted)"},
        {scene(R"({"kind": "particles", "radius": -1})"),
         "fluid.radius is -1, must be in [1e-06, 1000]"},
        {scene(R"({"kind": "particles", "radius": "big"})"),
         "fluid.radius is of type string, must be a number"},
        {scene(R"({"kind": "particles", "iterations": 1.5})"),
         "fluid.iterations is of type number, must be a whole number"},
        {scene(R"({"kind": "particles", "gravity": [0, 1]})"),
         "fluid.gravity must have 3 entries, has 2"},
        {scene(R"({"kind": "particles", "gravity": [0, "a", 0]})"),
         "fluid.gravity[1] is of type string, must be a number"},
        {scene(R"({"kind": "particles", "colour": 1})"),
         R"(fluid has the unknown member "colour")"},
        {scene(R"({"kind": "particles", "streams": []})"),
         R"(fluid has the unknown member "streams")"},
        {scene(R"({"kind": "particles", "sources": {}})"),
         "fluid.sources is of type object, must be a list"},
        {scene(R"({"kind": "particles", "sources": [{"centre": [0, 0, 0]}]})"),
         "fluid.sources[0].velocity is missing"},
        {scene(R"({"kind": "particles",
                   "rains": [{"centre": [0, 0, 0], "width": 0, "depth": 1, "rate": 1}]})"),
         "fluid.rains[0].width is 0, must be above 0"},
        {scene(R"({"kind": "particles", "sinks": [{"low": [0, 0, 0], "high": [1, 0, 1]}]})"),
         "fluid.sinks[0].low must be below high"},
        {scene(R"({"kind": "scripted"})"), "fluid.streams must hold at least one stream"},
        {scene(R"({"kind": "scripted", "streams": [{"path": [], "above_bed": 1}]})"),
         "fluid.streams[0] must have either path or above_bed"},
        {scene(kStream, R"(, "run": {"steps": -4})"), "run.steps is -4"},
        {scene(kStream, R"(, "run": {"scheme": "wind"})"),
         R"(run.scheme is "wind", must be one of wear, sediment)"},
        {scene(kStream, R"(, "run": {"keep_dose": 1})"),
         "run.keep_dose is of type number, must be true or false"},
        {scene(kStream, R"(, "extra": {})"), R"(s.json: the file has the unknown member "extra")"},
        {R"({"format": "scree-erosion", "version": 1, "mesh": {}, "fluid": {}})",
         "mesh must have either file or ground"},
        {R"({"format": "scree-erosion", "version": 1, "mesh": {"file": 4}, "fluid": {}})",
         "mesh.file is of type number, must be a string"},
    };
    for (const BadScene& bad : cases)
        EXPECT_THAT([&] { erosion_scene_from_json(bad.text, "s.json"); },
                    ThrowsMessage<InvalidInput>(HasSubstr(bad.message)))
            << bad.text;
    EXPECT_THROW(erosion_scene_from_json(std::string(1 << 21, ' '), "s.json"), InvalidInput);
    EXPECT_THROW(erosion_scene_from_json(std::string(100000, '['), "s.json"), InvalidInput);
}

class Ground : public testing::TestWithParam<GroundShape> {};

TEST_P(Ground, IsAnEvenMeshThatFacesUp) {
    GroundOptions options;
    options.shape = GetParam();
    options.edge = 0.2;
    const auto mesh = terrain::make_ground(options);
    const auto report = meshing::analyse_topology(mesh);
    EXPECT_TRUE(report.manifold);
    EXPECT_EQ(report.n_thin, 0U);
    EXPECT_EQ(report.closed, options.shape == GroundShape::Block);
    const auto adjacency = meshing::build_adjacency(mesh);
    EXPECT_NEAR(meshing::mean_edge_length(mesh, adjacency), 0.22, 0.05);
    if (options.shape == GroundShape::Block) {
        EXPECT_NEAR(meshing::signed_volume(mesh), 27.0, 1e-4);
        return;
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        EXPECT_GT(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a).y, 0.0F);
    }
    float lowest = 1.0F;
    for (const glm::vec3& p : mesh.positions)
        lowest = std::min(lowest, p.y);
    EXPECT_NEAR(lowest, 0.0F, 1e-6F);
}
INSTANTIATE_TEST_SUITE_P(Shapes, Ground,
                         testing::Values(GroundShape::Slope, GroundShape::Canyon, GroundShape::Bend,
                                         GroundShape::Block));

TEST(Ground, RefusesWhatDoesNotFit) {
    EXPECT_THAT([] { terrain::make_ground({.width = 1.0, .bed_width = 2.0}); },
                ThrowsMessage<InvalidInput>(HasSubstr("make it wider")));
    EXPECT_THAT([] { terrain::make_ground({.length = 1e4, .width = 1e4, .edge = 0.1}); },
                ThrowsMessage<InvalidInput>(HasSubstr("take longer edges")));
    EXPECT_THROW(terrain::make_ground({.edge = 0.0}), InvalidOption);
}

}  // namespace
}  // namespace scree
