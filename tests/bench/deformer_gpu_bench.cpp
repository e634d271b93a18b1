// One iteration of the sound deformer, four, and one of the literal, on the best OpenGL device
// there is. The label is the device; bytes are those that must cross its memory: base, soil and
// displacement read, displacement written. On a machine with a graphics card:
//   build/release/tests/bench/deformer_gpu --benchmark_out=gpu.json --benchmark_out_format=json
#include "terrain/gpu/deformer_gpu.h"
#include "tests/terrain/grid/ground_fixtures.h"

#include <benchmark/benchmark.h>

namespace {

using namespace scree;
using namespace scree::terrain;

// What a software device is spared: it would take a minute there.
constexpr int kMostCellsInSoftware = 2048;

void run(benchmark::State& state, const DeformerOptions& options) {
    const int side = static_cast<int>(state.range(0));
    const auto attempt = GlContext::try_make();
    if (!attempt.context) {
        state.SkipWithError(attempt.reason.c_str());
        return;
    }
    state.SetLabel(attempt.context->device());
    if (attempt.context->is_software() && side > kMostCellsInSoftware) {
        state.SkipWithError("for graphics cards alone");
        return;
    }
    const Heightfield ground = test::rough_ground(side, side, 8.0, 1);
    GpuDeformer deformer(*attempt.context, ground, SoilField(kSand), options);
    deformer.step({});
    for (auto _ : state)
        benchmark::DoNotOptimize(deformer.step({}));
    const auto cells = static_cast<std::int64_t>(side) * side;
    state.SetBytesProcessed(state.iterations() * cells * 13);
    state.SetItemsProcessed(state.iterations() * cells * options.iterations);
}

void sound(benchmark::State& state) {
    run(state, {.iterations = 1, .keep_base = false});
}
void sound_x4(benchmark::State& state) {
    run(state, {.iterations = 4, .keep_base = false});
}
void literal(benchmark::State& state) {
    run(state, {.reading = Reading::Literal, .iterations = 1});
}

void sizes(benchmark::internal::Benchmark* b) {
    b->RangeMultiplier(2)->Range(256, 8192)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(sound)->Name("deformer_gpu/sound")->Apply(sizes);
BENCHMARK(sound_x4)->Name("deformer_gpu/sound_x4")->Apply(sizes);
BENCHMARK(literal)->Name("deformer_gpu/literal")->Apply(sizes);

}  // namespace
