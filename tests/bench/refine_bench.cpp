#include "testdata/synthetic_photo.h"
#include "vision/refine/refine_outlines.h"

#include <benchmark/benchmark.h>

namespace {

using namespace scree;

// Boundary: 1 along the true outlines, falling to 0 over a few pixels.
vision::EdgeField field_of(const test::SyntheticPhoto& scene) {
    vision::EdgeField field;
    field.boundary = FloatRaster(scene.labels.width(), scene.labels.height());
    field.inside = field.boundary;
    for (int y = 1; y + 1 < scene.labels.height(); ++y)
        for (int x = 1; x + 1 < scene.labels.width(); ++x) {
            const auto here = scene.labels(x, y);
            const bool border = here != scene.labels(x + 1, y) || here != scene.labels(x, y + 1);
            field.boundary(x, y) = border ? 1.0F : 0.0F;
            field.inside(x, y) = here != 0 ? 1.0F : 0.0F;
        }
    return field;
}

// One megapixel with some 400 rocks; items are rocks.
void refine(benchmark::State& state) {
    const auto scene = test::make_synthetic_photo({.width = 1200, .height = 850});
    const auto field = field_of(scene);
    for (auto _ : state)
        benchmark::DoNotOptimize(
            vision::refine_outlines(scene.photo, field, scene.outlines).report.refined);
    state.SetItemsProcessed(state.iterations() * static_cast<long>(scene.outlines.size()));
}
BENCHMARK(refine)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
