#include "terrain/grid/settle.h"
#include "terrain/grid/sound_step.h"
#include "tests/support/sand_piles.h"

#include <array>
#include <string>

#include <benchmark/benchmark.h>

// A cone of sand of slope 2.0 (63 degrees) until no face between neighbours is steeper than 1.02
// times the tangent of its repose: 30 degrees everywhere, or 30 degrees left of
// the middle and 40 right of it (`_two_soils`).
namespace {

using namespace scree;
using namespace scree::terrain;

constexpr double kOver = 0.02;
constexpr int kMostSteps = 100'000;

struct Scene {
    Heightfield base;
    SoilTile soil;
    FloatRaster pile;
};

struct Pile {
    const char* suffix = "";
    int right_repose_deg = 30;
    int side = 256;
};

Scene scene_of(const Pile& pile) {
    return {{FloatRaster(pile.side, pile.side), 1.0},
            test::two_soils(pile.side, 30, pile.right_repose_deg),
            test::cone(pile.side, pile.side / 4.0, 2.0)};
}

// Greatest tangent of a face over that of its repose, and the share of faces above 1 + kOver.
struct Steepness {
    double greatest = 0.0;
    double share = 0.0;
};

Steepness steepness(const FloatRaster& u, const SoilTile& soil) {
    Steepness result;
    long over = 0;
    long faces = 0;
    const auto face = [&](int ax, int ay, int bx, int by) {
        const float d = u(bx, by) - u(ax, ay);
        const double ratio = static_cast<double>(
            std::fabs(d) / (d > 0.0F ? soil.tan_repose(bx, by) : soil.tan_repose(ax, ay)));
        result.greatest = std::max(result.greatest, ratio);
        over += ratio > 1.0 + kOver ? 1 : 0;
        ++faces;
    };
    for (int y = 0; y < u.height(); ++y)
        for (int x = 0; x < u.width(); ++x) {
            if (x + 1 < u.width())
                face(x, y, x + 1, y);
            if (y + 1 < u.height())
                face(x, y, x, y + 1);
        }
    result.share = static_cast<double>(over) / static_cast<double>(faces);
    return result;
}

void report(benchmark::State& state, const Scene& scene, const FloatRaster& rest, double sweeps) {
    const Steepness steep = steepness(rest, scene.soil);
    const double before = test::sum_of(scene.pile);
    state.counters["sweeps"] = sweeps;
    state.counters["relative_drift"] = std::abs(test::sum_of(rest) - before) / before;
    state.counters["steepest_over_percent"] = 100.0 * (steep.greatest - 1.0);
    state.counters["faces_over_percent"] = 100.0 * steep.share;
    state.counters["steepest_over_deg"] = test::steepest_over_deg(rest, scene.soil, 1.0);
}

void cone_to_rest(benchmark::State& state, const Pile& pile) {
    const Scene scene = scene_of(pile);
    FloatRaster u;
    SettleReport settled;
    for (auto _ : state) {
        u = scene.pile;
        settled = settle_to_rest(u, scene.base, scene.soil);
        benchmark::DoNotOptimize(u.data());
    }
    report(state, scene, u, settled.sweeps);
}

// One explicit step of the sound scheme's excess slide, in the plainest loops that vectorise.
void explicit_step(const FloatRaster& from, FloatRaster& to, const SoilTile& soil) {
    const int width = from.width();
    to = from;
    const auto flux = [](float d, float rise, float fall) {
        return 0.25F * (std::max(d - rise, 0.0F) + std::min(d + fall, 0.0F));
    };
    for (int y = 0; y < from.height(); ++y) {
        const float* h = from.row(y);
        const float* tan = soil.tan_repose.row(y);
        float* out = to.row(y);
        for (int x = 0; x + 1 < width; ++x) {
            const float handed = flux(h[x + 1] - h[x], tan[x + 1], tan[x]);
            out[x] += handed;
            out[x + 1] -= handed;
        }
        if (y + 1 == from.height())
            break;
        const float* below = from.row(y + 1);
        const float* tan_below = soil.tan_repose.row(y + 1);
        float* out_below = to.row(y + 1);
        for (int x = 0; x < width; ++x) {
            const float handed = flux(below[x] - h[x], tan_below[x], tan[x]);
            out[x] += handed;
            out_below[x] -= handed;
        }
    }
}

void cone_explicit(benchmark::State& state, const Pile& pile) {
    const Scene scene = scene_of(pile);
    FloatRaster u;
    int steps = 0;
    for (auto _ : state) {
        u = scene.pile;
        FloatRaster next = u;
        for (steps = 0; steps < kMostSteps; ++steps) {
            if (steps % 50 == 0 && steepness(u, scene.soil).greatest <= 1.0 + kOver)
                break;
            explicit_step(u, next, scene.soil);
            std::swap(u, next);
        }
    }
    report(state, scene, u, steps);
}

// The thermal erosion that common tools offer: a cell looks at its eight neighbours, and gives half
// of its greatest excess over the talus to those that lie lower by more than the talus, shared out
// by their excess.
void thermal_step(const FloatRaster& from, FloatRaster& to, const SoilTile& soil) {
    constexpr std::array<std::array<int, 2>, 8> kAround{
        {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    to = from;
    for (int y = 0; y < from.height(); ++y)
        for (int x = 0; x < from.width(); ++x) {
            std::array<float, 8> excess{};
            float sum = 0.0F;
            float greatest = 0.0F;
            for (std::size_t i = 0; i < kAround.size(); ++i) {
                const auto [dx, dy] = kAround[i];
                if (!from.contains(x + dx, y + dy))
                    continue;
                const float run = dx != 0 && dy != 0 ? 1.41421356F : 1.0F;
                const float drop = from(x, y) - from(x + dx, y + dy);
                excess[i] = std::max(0.0F, drop - soil.tan_repose(x, y) * run);
                sum += excess[i];
                greatest = std::max(greatest, excess[i]);
            }
            if (sum == 0.0F)
                continue;
            to(x, y) -= 0.5F * greatest;
            for (std::size_t i = 0; i < kAround.size(); ++i)
                if (excess[i] > 0.0F)
                    to(x + kAround[i][0], y + kAround[i][1]) += 0.5F * greatest * excess[i] / sum;
        }
}

void cone_thermal_8(benchmark::State& state, const Pile& pile) {
    const Scene scene = scene_of(pile);
    FloatRaster u;
    int steps = 0;
    for (auto _ : state) {
        u = scene.pile;
        FloatRaster next = u;
        for (steps = 0; steps < 4000; ++steps) {
            if (steps % 50 == 0 && steepness(u, scene.soil).greatest <= 1.0 + kOver)
                break;
            thermal_step(u, next, scene.soil);
            std::swap(u, next);
        }
    }
    report(state, scene, u, steps);
}

using Run = void (*)(benchmark::State&, const Pile&);

benchmark::internal::Benchmark* named(const std::string& name, Run run, const Pile& pile) {
    const auto bound = [run, pile](benchmark::State& state) { run(state, pile); };
    return benchmark::RegisterBenchmark((name + pile.suffix).c_str(), bound)
        ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
    const Pile one;
    const Pile two{.suffix = "_two_soils", .right_repose_deg = 40};
    for (const Pile& pile : {one, two}) {
        named("deformer/cone_to_rest", cone_to_rest, pile);
        named("deformer/cone_explicit", cone_explicit, pile)->Iterations(1);
        named("deformer/cone_thermal_8", cone_thermal_8, pile)->Iterations(1);
    }
    named("deformer/cone_to_rest", cone_to_rest, {.suffix = "/1024", .side = 1024});
    return true;
}();

}  // namespace
