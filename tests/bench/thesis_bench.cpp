#include "base/parallel.h"
#include "testdata/synthetic_photo.h"
#include "vision/thesis/edge_linking.h"
#include "vision/thesis/level_slicing.h"
#include "vision/thesis/slice_finder.h"
#include "vision/thesis/thesis_method.h"

#include <benchmark/benchmark.h>

namespace {

using namespace scree;

// 900 x 600 pixels: the source's working width.
const Photo& photo() {
    static const Photo picture =
        test::make_synthetic_photo({.layout = test::Layout::Cells, .gap = 3}).photo;
    return picture;
}

const vision::EdgeStages& edges() {
    static const vision::EdgeStages stages = vision::detect_thesis_edges(photo(), {});
    return stages;
}

void thesis_median(benchmark::State& state) {
    edges();  // made outside the timing
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::median_filtered(edges().grey, 5));
}
BENCHMARK(thesis_median)->Unit(benchmark::kMillisecond);

void thesis_level_slicing(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::accumulate_changes(edges().median, {}));
}
BENCHMARK(thesis_level_slicing)->Unit(benchmark::kMillisecond);

void thesis_hysteresis(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::hysteresis(edges().accumulation, edges().thresholds));
}
BENCHMARK(thesis_hysteresis)->Unit(benchmark::kMillisecond);

void thesis_linking(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::link_edges(edges().thresholded, {}));
}
BENCHMARK(thesis_linking)->Unit(benchmark::kMillisecond);

void thesis_slices(benchmark::State& state) {
    const ThreadLimit limit(static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::find_slices(edges().linked, {}));
}
BENCHMARK(thesis_slices)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void thesis_slices_serial(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::find_slices_serially(edges().linked, {}));
}
BENCHMARK(thesis_slices_serial)->Unit(benchmark::kMillisecond)->UseRealTime();

void thesis_whole(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(vision::find_thesis_rocks(photo()));
}
BENCHMARK(thesis_whole)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
