#include "meshing/rocks/rock_lod.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/rock_patch.h"
#include "tests/support/rock_samples.h"

#include <benchmark/benchmark.h>

namespace {

using namespace scree;

void rock_meshes(benchmark::State& state, bool size_lod) {
    const auto set = test::rock_set(static_cast<int>(state.range(0)), 1);
    std::size_t triangles = 0;
    for (auto _ : state) {
        const auto meshes = meshing::build_rock_meshes(set, {.size_lod = size_lod});
        triangles = 0;
        for (const auto& rock : meshes)
            triangles += rock.mesh.triangles.size();
        benchmark::DoNotOptimize(triangles);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["triangles"] = static_cast<double>(triangles);
}
BENCHMARK_CAPTURE(rock_meshes, by_size, true)
    ->Arg(125)
    ->Arg(500)
    ->Arg(2000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(rock_meshes, all_30_segments, false)
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

}  // namespace
