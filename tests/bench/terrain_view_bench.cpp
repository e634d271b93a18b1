// The source's table 4.1 on the device at hand: a frame of 1280 x 720 by tessellation and grid,
// a lattice of as many patches as the grid has cells, refined round one place; and one iteration of
// the deformer apart. The label is the device.
#include "terrain/gpu/deformer_gpu.h"
#include "terrain/view/terrain_view.h"
#include "tests/terrain/view/sample_ground.h"

#include <benchmark/benchmark.h>

namespace {

using namespace scree;
using namespace scree::terrain;

std::unique_ptr<GlContext> context_for(benchmark::State& state) {
    auto attempt = GlContext::try_make();
    if (attempt.context)
        state.SetLabel(attempt.context->device());
    else
        state.SkipWithError(attempt.reason.c_str());
    return std::move(attempt.context);
}

// Frames with 64 x 64 changed cells.
void draw_frames(benchmark::State& state, GlContext& context, int side,
                 const TerrainViewOptions& options) {
    const Heightfield base = test::rolling_ground(side);
    const DescriptionMap map = test::three_strips(4.0);
    TerrainView view(context, {&base, &map, test::strip_looks(256), {}}, options);
    const FloatRaster groove = test::groove(base);
    TerrainFrame frame;
    frame.camera = camera_over(base, 20.0, 38.0, 16.0 / 9.0);
    frame.displacement = &groove;
    view.draw(frame);
    const FloatRaster part(64, 64, -0.01F);
    frame.displacement = &part;
    frame.changed = {side / 2, side / 2, 64, 64};
    for (auto _ : state)
        benchmark::DoNotOptimize(view.draw(frame));
}

void table_frame(benchmark::State& state) {
    const auto context = context_for(state);
    if (!context)
        return;
    const int side = static_cast<int>(state.range(1));
    draw_frames(state, *context, side,
                {.width = 1280,
                 .height = 720,
                 .supersampling = 1,
                 .lattice = side,
                 .tessellation = static_cast<double>(state.range(0)),
                 .refine_radius_m = 4.0 * 4.0 / side});
}

void table_compute(benchmark::State& state) {
    const auto context = context_for(state);
    if (!context)
        return;
    const Heightfield base = test::rolling_ground(static_cast<int>(state.range(0)));
    GpuDeformer deformer(*context, base, SoilField(kSand), {.iterations = 1});
    for (auto _ : state)
        benchmark::DoNotOptimize(deformer.step({}));
}

// What `scree deform` and `scree render` draw: 512 x 512 cells, 640 x 400 pixels.
void usual_frame(benchmark::State& state) {
    const auto context = context_for(state);
    if (context)
        draw_frames(state, *context, 512, {.width = 640, .height = 400});
}

BENCHMARK(usual_frame)
    ->Name("terrain_view/usual_frame")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(table_frame)
    ->Name("terrain_view/table_4_1")
    ->ArgNames({"T", "grid"})
    ->ArgsProduct({{8, 16, 32, 64}, {512, 1024, 2048}})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.1)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(table_compute)
    ->Name("terrain_view/compute")
    ->RangeMultiplier(2)
    ->Range(512, 2048)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
