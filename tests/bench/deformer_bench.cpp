#include "base/parallel.h"
#include "base/random.h"
#include "base/simd.h"
#include "terrain/grid/deformer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace scree;
using namespace scree::terrain;

/// Rough enough to slide everywhere and in every iteration of a benchmark.
const Heightfield& rough_ground(int size) {
    static std::map<int, Heightfield> grounds;
    Heightfield& ground = grounds[size];
    if (ground.heights.empty()) {
        Rng rng({.seed = 1});
        ground = {FloatRaster(size, size), 1.0};
        for (float& height : ground.heights)
            height = static_cast<float>(40.0 * rng.uniform());
    }
    return ground;
}

void set_counters(benchmark::State& state, int size, int iterations) {
    state.counters["cells"] = static_cast<double>(size) * size;
    state.counters["iterations_per_step"] = iterations;
}

// --- The published scheme, and the plain loop that it is held against. ---

/// One literal iteration, (4.9) to (4.11) on one soil without loads, as one would write it down.
SCREE_MULTIVERSION void plain_row(const float* above, const float* here, const float* below, int n,
                                  float* __restrict out) {
    constexpr float kDiffusion = 0.2F;
    constexpr float kRepose = 0.593F;
    constexpr float kRoom = 1.0F / (1.57079633F - kRepose);
    const auto weighted = [](float term) {
        const float size = std::fabs(term);
        const float z = size > 1.0F ? 1.0F / size : size;
        float sum = -0.00455979199F;
        sum = sum * z + 0.0237805186F;
        sum = sum * z - 0.0588297531F;
        sum = sum * z + 0.0986886546F;
        sum = sum * z - 0.140032902F;
        sum = sum * z + 0.199669618F;
        sum = sum * z - 0.333318127F;
        sum = (sum * z + 0.999999882F) * std::sqrt(z);
        const float angle = size > 1.0F ? 1.57079633F - sum : sum;
        return (angle - kRepose) * kRoom * term;
    };
    for (int x = 0; x < n; ++x) {
        const float term_x = kDiffusion * (here[x - 1] + here[x + 1] - 2.0F * here[x]);
        const float term_z = kDiffusion * (above[x] + below[x] - 2.0F * here[x]);
        out[x] = here[x] + weighted(term_x) + weighted(term_z);
    }
}

void literal_plain_loop(benchmark::State& state) {
    const int size = static_cast<int>(state.range(0));
    FloatRaster now = rough_ground(size).heights;
    FloatRaster next = now;
    for (auto _ : state) {
        parallel_for_each_index(1, static_cast<std::size_t>(size) - 1, 32, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            plain_row(now.row(y - 1) + 1, now.row(y) + 1, now.row(y + 1) + 1, size - 2,
                      next.row(y) + 1);
        });
        std::swap(now, next);
    }
    set_counters(state, size, 1);
}

void literal(benchmark::State& state) {
    const int size = static_cast<int>(state.range(0));
    Deformer deformer(rough_ground(size), SoilField(kSand),
                      {.reading = Reading::Literal, .iterations = 1});
    for (auto _ : state)
        deformer.step({});
    set_counters(state, size, 1);
}

// --- The sound scheme, and a pass over the same bytes. ---

SCREE_MULTIVERSION void triad_row(const float* a, const float* b, int n, float* __restrict out) {
    for (int x = 0; x < n; ++x)
        out[x] = a[x] + 0.5F * b[x];
}

/// Read two floats and write one for each cell: what a sound iteration must.
void stream_pass(benchmark::State& state) {
    const int size = static_cast<int>(state.range(0));
    const FloatRaster base(size, size, 1.0F);
    FloatRaster now(size, size, 2.0F);
    FloatRaster next(size, size);
    for (auto _ : state) {
        parallel_for_each_index(0, static_cast<std::size_t>(size), 32, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            triad_row(base.row(y), now.row(y), size, next.row(y));
        });
        std::swap(now, next);
    }
    set_counters(state, size, 1);
}

/// Whole grids slide, because the base is loose too; small ones would come to rest after a while.
void step_whole_grid(benchmark::State& state, const SoilField& soil, int iterations) {
    constexpr int kFrames = 64;
    const int size = static_cast<int>(state.range(0));
    const Heightfield& ground = rough_ground(size);
    std::unique_ptr<Deformer> deformer;
    int all = 0;
    int least = std::numeric_limits<int>::max();
    int frame = 0;
    for (auto _ : state) {
        if (frame++ % kFrames == 0) {
            state.PauseTiming();
            deformer = std::make_unique<Deformer>(
                ground, soil, DeformerOptions{.iterations = iterations, .keep_base = false});
            all = deformer->step({}).tiles_stepped;
            deformer->step({});
            state.ResumeTiming();
        }
        least = std::min(least, deformer->step({}).tiles_stepped);
    }
    set_counters(state, size, iterations);
    state.counters["share_of_tiles"] = static_cast<double>(least) / all;
}

void sound(benchmark::State& state) {
    step_whole_grid(state, SoilField(kSand), 1);
}

void sound_x4(benchmark::State& state) {
    step_whole_grid(state, SoilField(kSand), 4);
}

void per_cell_repose_1thread(benchmark::State& state) {
    const ThreadLimit limit(1);
    const int size = static_cast<int>(state.range(0));
    Rng rng({.seed = 2});
    DescriptionMap map;
    map.ids = Raster<std::uint8_t>(size, size);
    map.repose = FloatRaster(size, size);
    for (float& repose : map.repose)
        repose = static_cast<float>(rng.uniform(0.3, 0.8));
    map.materials.emplace_back().name = "sand";
    step_whole_grid(state, SoilField(std::move(map), 1.0), 1);
}

// --- Little of a large ground. ---

/// A wheel lying on the ground: an ellipsoid with a window around it, pressed in by `depth`.
Load wheel(double cx, double cy, int window, double radius, double depth) {
    Load load;
    load.window = {static_cast<int>(cx) - window / 2, static_cast<int>(cy) - window / 2, window,
                   window};
    load.force_x = FloatRaster(window, window);
    load.force_z = load.force_x;
    load.underside = FloatRaster(window, window, std::numeric_limits<float>::infinity());
    for (int y = 0; y < window; ++y)
        for (int x = 0; x < window; ++x) {
            const double dx = load.window.x + x - cx;
            const double dy = load.window.y + y - cy;
            const double distance = std::hypot(dx, dy);
            if (distance > radius)
                continue;
            load.force_x(x, y) = static_cast<float>(0.2 + 0.1 * dx / radius);
            load.force_z(x, y) = static_cast<float>(0.1 * dy / radius);
            load.underside(x, y) =
                static_cast<float>(-depth * (1.0 - distance * distance / (radius * radius)));
        }
    return load;
}

/// A wheel of 16 cells rolls half a cell in each frame of four iterations.
void sparse_wheel(benchmark::State& state) {
    const int size = static_cast<int>(state.range(0));
    const Heightfield ground{FloatRaster(size, size), 0.05};
    Deformer deformer(ground, SoilField(kSand));
    double x = 0.25 * size;
    const auto frame = [&] {
        const Load load = wheel(x, 0.5 * size, 40, 16.0, 0.1);
        x += 0.5;
        return deformer.step({&load, 1}).tiles_stepped;
    };
    frame();
    int most = 0;
    for (auto _ : state)
        most = std::max(most, frame());
    state.counters["tiles_stepped"] = most;
    state.counters["MiB_beyond_base"] = static_cast<double>(deformer.bytes()) / 1048576.0;
}

/// The load's window has 256 x 256 cells, and the wheel fills it.
void window_256(benchmark::State& state) {
    const Heightfield ground{FloatRaster(1024, 1024), 0.05};
    Deformer deformer(ground, SoilField(kSand), {.iterations = static_cast<int>(state.range(0))});
    std::vector<Load> loads;
    for (int i = 0; i < 16; ++i)
        loads.push_back(wheel(512.0 + i, 512.0, 256, 120.0, 0.5));
    std::size_t frame = 0;
    int most = 0;
    for (auto _ : state) {
        most = std::max(most, deformer.step({&loads[frame % loads.size()], 1}).tiles_stepped);
        ++frame;
    }
    state.counters["tiles_stepped"] = most;
    state.counters["iterations_per_step"] = static_cast<double>(state.range(0));
}

// --- Volume over many steps of one iteration, piles and contacts apart. ---

/// What the displacements sum up to, as a share of all that moved.
double drift_of(const Deformer& deformer) {
    double sum = 0.0;
    double moved = 0.0;
    for (const float u : deformer.displacement(deformer.extent())) {
        sum += double{u};
        moved += std::fabs(double{u});
    }
    return std::fabs(sum) / moved;
}

Heightfield sand_cone(int size) {
    Heightfield ground{FloatRaster(size, size), 0.05};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            ground.heights(x, y) = static_cast<float>(
                0.1 * std::max(0.0, size / 3.0 - std::hypot(x - size / 2.0, y - size / 2.0)));
    return ground;
}

void volume_of_piles(benchmark::State& state, Reading reading, int steps) {
    const Heightfield ground = sand_cone(256);
    for (auto _ : state) {
        Deformer deformer(
            ground, SoilField(kSand),
            {.reading = reading, .iterations = 1, .keep_base = false, .clamp_weights = true});
        for (int step = 0; step < steps; ++step)
            deformer.step({});
        state.counters["relative_drift"] = drift_of(deformer);
    }
}

void volume_of_contacts(benchmark::State& state, Reading reading, int steps) {
    const Heightfield ground{FloatRaster(256, 256), 0.05};
    for (auto _ : state) {
        Deformer deformer(ground, SoilField(kSand),
                          {.reading = reading, .iterations = 1, .clamp_weights = true});
        for (int step = 0; step < steps; ++step) {
            Load load = wheel(128.0 + 80.0 * std::sin(0.004 * step),
                              128.0 + 60.0 * std::sin(0.0031 * step), 40, 16.0, 0.1);
            if (reading ==
                Reading::Literal)  // weaker forces move nothing there: (4.11) is too flat
                for (FloatRaster* force : {&load.force_x, &load.force_z})
                    for (float& f : *force)
                        f *= 20.0F;
            deformer.step({&load, 1});
        }
        state.counters["relative_drift"] = drift_of(deformer);
    }
}

benchmark::internal::Benchmark* timed(const char* name, void (*run)(benchmark::State&)) {
    return benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
    timed("deformer/literal_plain_loop", literal_plain_loop)->Arg(512)->Arg(1024)->Arg(2048);
    timed("deformer/literal", literal)->Arg(512)->Arg(1024)->Arg(2048);
    timed("deformer/stream_pass", stream_pass)->Arg(512)->Arg(1024)->Arg(2048);
    timed("deformer/sound", sound)->Arg(60)->RangeMultiplier(2)->Range(256, 8192);
    timed("deformer/sound_x4", sound_x4)->Arg(512)->Arg(1024)->Arg(2048);
    timed("deformer/per_cell_repose_1thread", per_cell_repose_1thread)->Arg(1024);
    timed("deformer/sparse_wheel", sparse_wheel)->Arg(16384);
    timed("deformer/window_256", window_256)->Arg(1)->Arg(4);
    for (const Reading reading : {Reading::Sound, Reading::Literal}) {
        const bool sound_form = reading == Reading::Sound;
        const int steps = sound_form ? 10000 : 500;  // the literal form does not last as long
        benchmark::RegisterBenchmark(
            sound_form ? "deformer/volume_of_piles" : "deformer/literal_volume_of_piles",
            volume_of_piles, reading, steps)
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
        benchmark::RegisterBenchmark(
            sound_form ? "deformer/volume_of_contacts" : "deformer/literal_volume_of_contacts",
            volume_of_contacts, reading, steps)
            ->Unit(benchmark::kMillisecond)
            ->Iterations(1);
    }
    return true;
}();

}  // namespace
