#include "meshing/mesh/adjacency.h"
#include "terrain/fluid/position_fluid.h"
#include "terrain/fluid/scripted_fluid.h"
#include "terrain/surface/erosion_ground.h"
#include "terrain/surface/wet_erosion.h"
#include "tests/support/mesh_shapes.h"

#include <cmath>
#include <cstdlib>
#include <string>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

namespace {

using namespace scree;

// A closed body of about the size of the Stanford bunny: a bumpy sphere of one metre.
meshing::TriMesh bumpy_sphere(std::size_t n_vertices) {
    const auto n_tube = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(n_vertices) / 2.0)));
    const auto n_around = static_cast<std::uint32_t>((n_vertices + n_tube - 1) / n_tube);
    meshing::TriMesh mesh = test::torus(0.7, 0.3, n_around, n_tube);
    for (glm::vec3& p : mesh.positions)
        p *= 1.0F + 0.03F * std::sin(17.0F * p.x) * std::sin(19.0F * p.y) * std::sin(23.0F * p.z);
    return mesh;
}

// Water poured over it: particles on the upper half, a radius away from the surface.
std::vector<glm::vec3> poured(const meshing::TriMesh& mesh, std::size_t n) {
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

// The source's sizes: 34,835 vertices and 17,673 particles took it 291.5 ms a step, fluid apart.
void erosion_step(benchmark::State& state) {
    const auto n_particles = static_cast<std::size_t>(state.range(1));
    const meshing::TriMesh fresh = bumpy_sphere(static_cast<std::size_t>(state.range(0)));
    const meshing::Adjacency adjacency = meshing::build_adjacency(fresh);
    const auto water = poured(fresh, n_particles);
    terrain::WetErosionScratch scratch;
    terrain::WetErosionReport sum;
    meshing::TriMesh mesh = fresh;
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
    const auto ms = [&](double seconds) {
        return benchmark::Counter(1e3 * seconds, benchmark::Counter::kAvgIterations);
    };
    state.counters["vertices"] = static_cast<double>(fresh.positions.size());
    state.counters["particles"] = static_cast<double>(n_particles);
    state.counters["affected_ms"] = ms(sum.affected_seconds);
    state.counters["curvature_ms"] = ms(sum.curvature_seconds);
    state.counters["laplacian_ms"] = ms(sum.laplacian_seconds);
    state.counters["displacement_ms"] = ms(sum.displacement_seconds);
}
BENCHMARK(erosion_step)->Args({34834, 17673})->Unit(benchmark::kMillisecond)->UseRealTime();

void fluid_step(benchmark::State& state) {
    const double radius = 0.05;
    const double side = 2.0 * radius * std::cbrt(static_cast<double>(state.range(0)));
    const auto half = static_cast<float>(0.5 * side);
    terrain::PositionFluidSetup setup;
    setup.options.radius = radius;
    setup.emitters.pools = {{glm::vec3(-half, 1.0F, -half), glm::vec3(half, 1.0F + 2 * half, half)}};
    terrain::PositionFluid fluid(setup);
    const meshing::TriMesh mesh = terrain::make_ground({.shape = terrain::GroundShape::Canyon, .length=12, .width=8, .edge=0.08, .bed_width=3});
    fluid.set_mesh(mesh);
    for (int i = 0; i < 30; ++i)
        fluid.step(1.0 / 60);
    const terrain::FluidState start = fluid.state();
    double substeps = 0;
    std::size_t touching = 0;
    for (auto _ : state) {
        substeps += fluid.step(1.0 / 60);
        touching = terrain::colliding_positions(fluid.state()).size();
        state.PauseTiming();
        fluid.restore(start);
        state.ResumeTiming();
    }
    state.counters["particles"] = static_cast<double>(start.size());
    state.counters["touching"] = static_cast<double>(touching);
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    state.counters["substeps"] = benchmark::Counter(substeps, benchmark::Counter::kAvgIterations);
}
BENCHMARK(fluid_step)->Arg(17673)->Unit(benchmark::kMillisecond)->UseRealTime();

void set_mesh(benchmark::State& state) {
    terrain::PositionFluid fluid({});
    const meshing::TriMesh mesh = bumpy_sphere(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state)
        fluid.set_mesh(mesh);
}
BENCHMARK(set_mesh)->Arg(34834)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
