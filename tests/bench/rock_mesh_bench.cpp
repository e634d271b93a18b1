#include "meshing/rocks/patch_culling.h"
#include "meshing/rocks/procedural_rock.h"
#include "meshing/rocks/rock_lod.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/rock_patch.h"
#include "tests/support/rock_samples.h"

#include <benchmark/benchmark.h>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

namespace {

using namespace scree;

// The gain of fewer segments for smaller rocks, which the source puts at 2.8 in drawing.
void rock_meshes(benchmark::State& state, const meshing::RockMeshOptions& options) {
    const auto set = test::rock_set(static_cast<int>(state.range(0)), 1);
    std::size_t triangles = 0;
    for (auto _ : state) {
        const auto meshes = meshing::build_rock_meshes(set, options);
        triangles = 0;
        for (const auto& rock : meshes)
            triangles += rock.mesh.triangles.size();
        benchmark::DoNotOptimize(triangles);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["triangles"] = static_cast<double>(triangles);
}
BENCHMARK_CAPTURE(rock_meshes, by_size, meshing::RockMeshOptions{})
    ->Arg(125)
    ->Arg(500)
    ->Arg(2000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(rock_meshes, by_size_from_3, meshing::RockMeshOptions{.min_segments = 3})
    ->Arg(500)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(rock_meshes, all_30_segments, meshing::RockMeshOptions{.size_lod = false})
    ->Arg(125)
    ->Arg(500)
    ->Arg(2000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void lod_chains(benchmark::State& state) {
    const auto set = test::rock_set(static_cast<int>(state.range(0)), 1);
    const auto rocks = meshing::build_rock_meshes(set);
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::build_lod_chains(rocks));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(lod_chains)->Arg(125)->Arg(500)->Unit(benchmark::kMillisecond)->UseRealTime();

// The source's scene: 492 rocks on 10 x 10 patches; work is one instance.
void instance_buffer(benchmark::State& state) {
    const auto rocks = meshing::build_rock_meshes(test::rock_set(492, 1));
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::repeat_rocks(rocks, {0.9, 0.6}, 10, 10));
    state.SetItemsProcessed(state.iterations() * 49200);
}
BENCHMARK(instance_buffer)->Unit(benchmark::kMillisecond)->UseRealTime();

void culling(benchmark::State& state) {
    const auto rocks = meshing::build_rock_meshes(test::rock_set(492, 1));
    const auto patch = meshing::repeat_rocks(rocks, {0.9, 0.6}, 10, 10);
    const auto spheres = meshing::instance_spheres(patch, rocks);
    const glm::mat4 view = glm::perspective(0.8F, 1.5F, 0.1F, 20.0F) *
                           glm::lookAt(glm::vec3(0, 1.5F, 3), glm::vec3(0), glm::vec3(0, 1, 0));
    std::size_t visible = 0;
    for (auto _ : state)
        visible = meshing::visible_instances(spheres, view).size();
    state.SetItemsProcessed(state.iterations() * 49200);
    state.counters["visible"] = static_cast<double>(visible);
}
BENCHMARK(culling)->Unit(benchmark::kMillisecond)->UseRealTime();

void scattered_patch(benchmark::State& state) {
    const auto rocks = meshing::build_rock_meshes(test::rock_set(500, 1));
    double coverage = 0.0;
    double by_darts = 0.0;
    for (auto _ : state) {
        const auto patch = meshing::scatter_rocks(rocks, static_cast<int>(state.range(0)));
        coverage = patch.report.coverage;
        by_darts = patch.report.coverage_by_darts;
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["coverage"] = coverage;
    state.counters["by_darts"] = by_darts;
}
BENCHMARK(scattered_patch)
    ->Arg(500)
    ->Arg(2000)
    ->Arg(8000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void procedural_rock(benchmark::State& state) {
    meshing::ProceduralRockOptions options;
    options.segments = static_cast<int>(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(meshing::make_procedural_rock(options));
}
BENCHMARK(procedural_rock)->Arg(32)->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond);

}  // namespace
