#include "terrain/scene/simulation.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "terrain/contact/shapes.h"
#include "terrain/scene/scene_file.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;

Scene scene_of(const std::string& members) {
    return scene_from_json(R"({"format": "scree-scene", "version": 1, )" + members + "}", "s.json",
                           "");
}

std::string flat(int width, int height) {
    return R"("ground": {"width": )" + std::to_string(width) + R"(, "height": )" +
           std::to_string(height) + R"(, "cell_size_m": 0.02})";
}

std::string fine(int width, int height) {
    return R"("ground": {"width": )" + std::to_string(width) + R"(, "height": )" +
           std::to_string(height) + R"(, "cell_size_m": 0.01})";
}

// A ball that is dragged along x at a height, `radius_m` 0.16.
std::string dragged(double from_x, double to_x, double y, double z, double seconds) {
    const auto place = [&](double x) {
        return "[" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + "]";
    };
    return R"({"mass_kg": 40, "drag_n": 60, "shape": {"kind": "sphere", "radius_m": 0.16},
               "motion": {"to_s": )" +
           std::to_string(seconds) + R"(, "keys": [{"time_s": 0, "position_m": )" + place(from_x) +
           R"(}, {"time_s": )" + std::to_string(seconds) + R"(, "position_m": )" + place(to_x) +
           "}]}}";
}

void run(Simulation& simulation, int frames) {
    for (int i = 0; i < frames; ++i)
        simulation.step();
}

// Displacement across the track at column x: one value a row.
std::vector<double> profile(const Simulation& simulation, int x) {
    const CellWindow all = simulation.extent();
    const FloatRaster column = simulation.ground().displacement({x, 0, 1, all.height});
    return {column.begin(), column.end()};
}

struct Track {
    double depth = 0.0;  // below the old ground
    double rim = 0.0;    // above it
    double width = 0.0;  // of what lies below half the depth
    double span = 0.0;   // between the crests of both rims
};

Track track_at(const Simulation& simulation, int x) {
    const std::vector<double> heights = profile(simulation, x);
    const double size = simulation.base().cell_size;
    Track track;
    track.depth = -*std::min_element(heights.begin(), heights.end());
    track.rim = *std::max_element(heights.begin(), heights.end());
    for (const double u : heights)
        track.width += u < -0.5 * track.depth ? size : 0.0;
    const auto middle = std::min_element(heights.begin(), heights.end());
    track.span = size * static_cast<double>(std::max_element(middle, heights.end()) -
                                            std::max_element(heights.begin(), middle));
    return track;
}

const std::string kThree = R"(, "materials": [
   {"id": 0, "name": "sand", "repose_deg": 34, "mobility": 0.5, "diffusion": 0.2},
   {"id": 1, "name": "mud", "repose_deg": 58, "mobility": 0.25, "diffusion": 0.05},
   {"id": 2, "name": "pebbles", "repose_deg": 38, "mobility": 0.8, "diffusion": 0.12}],
  "regions": [{"material": "mud", "rect_m": [0.9, 0, 1.8, 9]},
              {"material": "pebbles", "rect_m": [1.8, 0, 9, 9]}])";

// TD-12, TD-22: one load, three tracks; each has a groove, rims on both sides and slopes that its
// material holds.
TEST(Simulation, ThreeMaterialsKeepThreeTracks) {
    const Scene scene = scene_of(fine(270, 100) + kThree + R"(, "frames": 40, "objects": [)" +
                                 dragged(0.1, 2.6, 0.1, 0.5, 1.2) + "]");
    Simulation simulation(scene, Device::Cpu);
    run(simulation, 140);
    const Track sand = track_at(simulation, 50);
    const Track mud = track_at(simulation, 135);
    const Track pebbles = track_at(simulation, 220);
    for (const Track& one : {sand, mud, pebbles}) {
        EXPECT_GT(one.depth, 0.02);
        EXPECT_LE(one.depth, 0.061);  // never below the ball
        EXPECT_GT(one.rim, 0.008);
    }
    EXPECT_GT(pebbles.rim, sand.rim + 0.003);  // pushed farthest aside
    EXPECT_GT(sand.rim, mud.rim + 0.003);      // that moves least
    EXPECT_GT(pebbles.span, sand.span);
    EXPECT_GT(sand.span, mud.span + 0.01);
    EXPECT_GT(pebbles.depth, sand.depth);
    const auto heights = profile(simulation, 50);
    const auto middle = heights.begin() + 50;
    EXPECT_GT(*std::max_element(heights.begin(), middle), 0.005);
    EXPECT_GT(*std::max_element(middle, heights.end()), 0.005);
    for (const MaterialReport& one : simulation.material_reports()) {
        EXPECT_GT(one.moved_m3, 0.0) << one.name;
        EXPECT_LT(one.greatest_slope_deg, one.repose_deg + 3.0) << one.name;
    }
    const VolumeReport volume = simulation.volume();
    EXPECT_LT(std::abs(volume.relative_drift), 1e-9);
    EXPECT_LT(std::abs(volume.drift_of_moved), 1e-6);
    EXPECT_GT(volume.moved_m3, 1e-4);
}

// TD-11: the groove follows a ball that grows, and never lies below it.
TEST(Simulation, AGrowingBallDigsAWidenedGroove) {
    const Scene scene = scene_of(flat(110, 50) + R"(, "objects": [{"mass_kg": 60, "drag_n": 50,
        "shape": {"kind": "sphere", "radius_m": 0.08}, "motion": {"keys": [
          {"time_s": 0, "position_m": [0.2, 0.04, 0.5], "scale": 1},
          {"time_s": 1.4, "position_m": [2.0, 0.12, 0.5], "scale": 2.5}]}}])");
    Simulation simulation(scene, Device::Cpu);
    run(simulation, 50);
    const Track early = track_at(simulation, 20);
    const Track late = track_at(simulation, 85);
    EXPECT_GT(late.depth, 1.3 * early.depth);
    EXPECT_GE(late.width, early.width);
    EXPECT_LE(late.depth, 0.081);
    const ObjectReport object = simulation.object_reports()[0];
    EXPECT_FALSE(object.smaller_than_cell);
    EXPECT_GT(object.most_cells, 30);
}

// TD-11: what is smaller than a cell leaves no track, and the report says so.
TEST(Simulation, ASubCellObjectIsLostAndReported) {
    const Scene scene = scene_of(flat(40, 40) + R"(, "objects": [{
        "shape": {"kind": "sphere", "radius_m": 0.004}, "motion": {"keys": [
          {"time_s": 0, "position_m": [0.4, -0.002, 0.4]}]}}])");
    Simulation simulation(scene, Device::Cpu);
    run(simulation, 3);
    EXPECT_EQ(simulation.volume().moved_m3, 0.0);
    EXPECT_TRUE(simulation.object_reports()[0].smaller_than_cell);
}

// FW-07: a mesh from a file leaves a track of its own shape. A bar is pressed in crosswise.
TEST(Simulation, AnyMeshLeavesItsOwnTrack) {
    const test::TempDir dir;
    meshing::GltfScene gltf;
    gltf.meshes.push_back({"bar", box_mesh({.size_m = {0.6, 0.2, 0.12}})});
    gltf.nodes.push_back({"bar", 0, {}, {}, {}, {}});
    write_whole_file(dir / "bar.glb", std::span<const std::uint8_t>(meshing::encode_glb(gltf)));
    const Scene scene = scene_of(flat(60, 60) + R"(, "objects": [{"mass_kg": 150,
        "shape": {"kind": "mesh", "file": ")" +
                                 (dir / "bar.glb").string() + R"("},
        "motion": {"keys": [{"time_s": 0, "position_m": [0.6, 0.2, 0.6]},
                            {"time_s": 0.6, "position_m": [0.6, 0.06, 0.6]}]}}])");
    Simulation simulation(scene, Device::Cpu);
    run(simulation, 40);
    const FloatRaster u = simulation.ground().displacement(simulation.extent());
    EXPECT_LT(u(30, 30), -0.02F);
    EXPECT_LT(u(18, 30), -0.01F);
    EXPECT_GE(u(30, 18), 0.0F);
    EXPECT_GE(*std::min_element(u.begin(), u.end()), -0.0401F);
    EXPECT_GT(*std::max_element(u.begin(), u.end()), 0.005F);
}

// A box on a Winkler bed sinks by weight over stiffness and area; dropped, it falls first.
TEST(Simulation, AWeightFallsAndSinksToItsBearing) {
    const Scene scene = scene_of(flat(60, 60) + R"(, "bearing_kpa_per_m": {"sand": 100},
        "contact": {"gravity": 10}, "frame_rate": 100, "objects": [{"mass_kg": 40,
        "shape": {"kind": "box", "size_m": [0.4, 0.2, 0.4]},
        "motion": {"ride": "weight",
                   "keys": [{"time_s": 0, "position_m": [0.6, 0.5, 0.6]}]}}])");
    Simulation simulation(scene, Device::Cpu);
    run(simulation, 20);  // half of g t^2 = 0.2 m, of the 0.4 that it can fall
    EXPECT_NEAR(simulation.objects()[0].world_from_mesh[3].y, 0.5 - 0.21, 0.002);
    run(simulation, 60);
    const double sunk = 40 * 10 / (100e3 * 0.4 * 0.4);
    EXPECT_NEAR(simulation.objects()[0].world_from_mesh[3].y, 0.1 - sunk, 1e-4);
    run(simulation, 40);  // and stays, though the soil below it gave way
    EXPECT_NEAR(simulation.objects()[0].world_from_mesh[3].y, 0.1 - sunk, 1e-4);
}

TEST(Simulation, ASteepPileSlumpsWhereTheBaseMayMove) {
    const std::string pile = R"("ground": {"width": 60, "height": 60, "cell_size_m": 0.02,
        "shapes": [{"kind": "pile", "centre_m": [0.61, 0.61], "height_m": 0.4, "slope_deg": 60}]})";
    const Scene kept = scene_of(pile);
    Simulation still(kept, Device::Cpu);
    run(still, 3);
    EXPECT_EQ(still.volume().moved_m3, 0.0);
    const Scene loose = scene_of(pile + R"(, "deformer": {"keep_base": false, "iterations": 50})");
    Simulation moving(loose, Device::Cpu);
    run(moving, 60);
    EXPECT_NEAR(moving.material_reports()[0].greatest_slope_deg, 34.0, 1.5);
    EXPECT_LT(std::abs(moving.volume().drift_of_moved), 1e-6);
}

TEST(Simulation, IsTheSameForAnyNumberOfThreads) {
    const Scene scene =
        scene_of(flat(120, 100) + kThree + R"(, "objects": [)" + dragged(0.1, 2.2, 0.1, 0.5, 0.6) +
                 "," + dragged(0.3, 2.2, 0.12, 0.8, 0.6) + "]");
    std::vector<FloatRaster> results;
    for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        Simulation simulation(scene, Device::Cpu);
        run(simulation, 12);
        results.push_back(simulation.ground().displacement(simulation.extent()));
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
}

TEST(Simulation, SettlesToItsReposeAtOnceAndGoesOn) {
    const Scene scene = scene_of(flat(80, 60) + R"(, "deformer": {"keep_base": false})" +
                                 R"(, "objects": [)" + dragged(0.2, 1.4, 0.1, 0.6, 0.4) + "]");
    Simulation simulation(scene, Device::Cpu);
    run(simulation, 8);
    EXPECT_GT(simulation.material_reports()[0].greatest_slope_deg, 36.0);
    EXPECT_TRUE(simulation.objects()[0].present);
    const SettleReport report = simulation.settle();
    EXPECT_GT(report.excess_before, 0.05);
    EXPECT_GT(report.moved_m3, 0.0);
    EXPECT_FALSE(simulation.objects()[0].present);  // lifted off
    EXPECT_LE(simulation.material_reports()[0].greatest_slope_deg, 34.1);
    EXPECT_LT(std::abs(simulation.volume().drift_of_moved), 1e-6);
    simulation.step();
    EXPECT_TRUE(simulation.objects()[0].present);  // and back
    EXPECT_LT(std::abs(simulation.volume().drift_of_moved), 1e-6);
    const Scene literal = scene_of(flat(20, 20) + R"(, "deformer": {"reading": "literal"})");
    EXPECT_THAT([&] { Simulation(literal, Device::Cpu).settle(); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("s.json: only the sound reading")));
}

TEST(SimulationErrors, NameTheScene) {
    // A map's own planes can break the bound that the materials keep.
    Scene scene = scene_of(flat(20, 20));
    scene.materials[0].soil.diffusion = 0.5;
    EXPECT_THAT([&] { Simulation(scene, Device::Cpu); },
                testing::ThrowsMessage<InvalidInput>(
                    testing::AllOf(HasSubstr("s.json: deformer"), HasSubstr("0.25"))));
    const Scene tread = scene_of(flat(20, 20) + R"(, "objects": [{
        "shape": {"kind": "tyre", "radius_m": 0.1, "tread_depth_m": 0.09},
        "motion": {"keys": [{"time_s": 0, "position_m": [0, 0, 0]}]}}])");
    EXPECT_THAT([&] { Simulation(tread, Device::Cpu); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("s.json: objects[0].shape")));
}

}  // namespace
}  // namespace scree::terrain
