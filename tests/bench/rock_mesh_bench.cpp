#include "meshing/rocks/rock_lod.h"
#include "meshing/rocks/rock_mesh.h"
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

}  // namespace
