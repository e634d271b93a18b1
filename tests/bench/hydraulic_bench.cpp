// Hydraulic erosion: hydraulic/<what>/<size>, with the source's five columns as counters.
#include "base/stopwatch.h"
#include "meshing/mesh/adjacency.h"
#include "terrain/fluid/position_fluid.h"
#include "terrain/surface/erosion_ground.h"
#include "terrain/surface/wet_erosion.h"
#include "tests/support/sphere_meshes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

namespace {

using namespace scree;
using meshing::TriMesh;

constexpr int kBunny = 34834;
constexpr std::size_t kParticles = 17673;

// Water that touches the upper half of a body, as if poured over it.
std::vector<glm::vec3> poured(const TriMesh& mesh, std::size_t n) {
    std::vector<glm::vec3> places;
    for (std::size_t k = 0; places.size() < n; ++k) {
        const glm::uvec3& t = mesh.triangles[k * 7919 % mesh.triangles.size()];
        const glm::vec3 middle =
            (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
        if (middle.y > 0.0F)
            places.push_back(middle * (1.0F + 0.001F * static_cast<float>(k % 7)));
    }
    return places;
}

// Water over a canyon's bed, already moving.
std::unique_ptr<terrain::PositionFluid> running_water(std::size_t n_particles, TriMesh& ground) {
    const auto half = static_cast<float>(0.05 * std::cbrt(static_cast<double>(n_particles)));
    terrain::PositionFluidSetup setup;
    setup.emitters.pools = {{{-half, 1.0F, -half}, {half, 1.0F + 2.0F * half, half}}};
    auto fluid = std::make_unique<terrain::PositionFluid>(setup);
    ground = terrain::make_ground({.length = 12, .width = 8, .edge = 0.08, .bed_width = 3});
    fluid->set_mesh(ground);
    for (int i = 0; i < 30; ++i)
        fluid->step(1.0 / 60);
    return fluid;
}

double frame_milliseconds() {
    TriMesh ground;
    const auto fluid = running_water(kParticles, ground);
    const terrain::FluidState start = fluid->state();
    double best = 1e9;
    for (int i = 0; i < 5; ++i) {
        Stopwatch watch;
        fluid->step(1.0 / 60);
        fluid->set_mesh(ground);
        best = std::min(best, 1e3 * watch.lap());
        fluid->restore(start);
    }
    return best;
}

// The source's sizes: 34,835 vertices and 17,673 particles took it 291.5 ms a step, its fluid
// apart. `fluid_ms` is a frame of as many particles of ours, the least of five.
void step(benchmark::State& state) {
    const TriMesh fresh = test::lumpy_sphere(static_cast<std::size_t>(state.range(0)));
    const meshing::Adjacency adjacency = meshing::build_adjacency(fresh);
    const auto water = poured(fresh, kParticles);
    TriMesh mesh = fresh;
    terrain::WetErosionScratch scratch;
    terrain::WetErosionReport sum;
    for (auto _ : state) {
        const auto report = terrain::erode_wet(mesh, adjacency, water, {}, scratch);
        sum.affected_seconds += report.affected_seconds;
        sum.curvature_seconds += report.curvature_seconds;
        sum.laplacian_seconds += report.laplacian_seconds;
        sum.displacement_seconds += report.displacement_seconds;
        state.PauseTiming();
        mesh.positions = fresh.positions;
        state.ResumeTiming();
    }
    const auto mean_ms = [](double seconds) {
        return benchmark::Counter(1e3 * seconds, benchmark::Counter::kAvgIterations);
    };
    state.counters["particles"] = static_cast<double>(kParticles);
    state.counters["affected_ms"] = mean_ms(sum.affected_seconds);
    state.counters["curvature_ms"] = mean_ms(sum.curvature_seconds);
    state.counters["laplacian_ms"] = mean_ms(sum.laplacian_seconds);
    state.counters["displacement_ms"] = mean_ms(sum.displacement_seconds);
    static const double fluid_ms = frame_milliseconds();
    state.counters["fluid_ms"] = fluid_ms;
}
BENCHMARK(step)->Name("hydraulic/step")->Arg(kBunny)->Unit(benchmark::kMillisecond);

void frame(benchmark::State& state) {
    TriMesh ground;
    const auto fluid = running_water(static_cast<std::size_t>(state.range(0)), ground);
    const terrain::FluidState start = fluid->state();
    int substeps = 0;
    for (auto _ : state) {
        substeps = fluid->step(1.0 / 60);
        state.PauseTiming();
        fluid->restore(start);
        state.ResumeTiming();
    }
    state.counters["particles"] = static_cast<double>(start.size());
    state.counters["touching"] = static_cast<double>(terrain::colliding_positions(start).size());
    state.counters["triangles"] = static_cast<double>(ground.triangles.size());
    state.counters["substeps"] = substeps;
}
BENCHMARK(frame)
    ->Name("hydraulic/frame")
    ->Arg(4400)
    ->Arg(17673)
    ->Arg(70000)
    ->Unit(benchmark::kMillisecond);

// What the fluid does with the mesh after every step.
void set_mesh(benchmark::State& state) {
    terrain::PositionFluid fluid({});
    const TriMesh mesh = test::lumpy_sphere(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state)
        fluid.set_mesh(mesh);
}
BENCHMARK(set_mesh)->Name("hydraulic/set_mesh")->Arg(kBunny)->Unit(benchmark::kMillisecond);

}  // namespace
