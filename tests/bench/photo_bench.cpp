// Whole runs of the program and the outlines alone, each beside the ordinary OpenCV way (Canny,
// then watershed) on the same picture in the same run. The picture is the demo photograph, mirrored
// and repeated to the size asked for, so that rocks keep their size in pixels.
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"
#include "vision/rock_extraction.h"
#include "vision/thesis/baseline_detectors.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <benchmark/benchmark.h>

namespace {

namespace fs = std::filesystem;
using scree::Photo;

const fs::path kPhoto = fs::path(SCREE_SOURCE_DIR) / "testdata/photos/gravel.png";

int mirrored(int i, int n) {
    const int j = i % (2 * n);
    return j < n ? j : 2 * n - 1 - j;
}

Photo ground(int width, int height) {
    const Photo tile = scree::vision::read_photo(kPhoto).pixels;
    Photo photo(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            photo(x, y) = tile(mirrored(x, tile.width()), mirrored(y, tile.height()));
    return photo;
}

// Runs the program and returns its greatest resident size in MiB.
double run_program(const fs::path& photo, const fs::path& out) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl(SCREE_PROGRAM, SCREE_PROGRAM, "rocks", photo.c_str(), "-o", out.c_str(), "--quiet",
                static_cast<char*>(nullptr));
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    if (child < 0 || ::wait4(child, &status, 0, &usage) != child || status != 0)
        throw std::runtime_error("the program failed");
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Seconds of the ordinary way on the same picture: the median of three runs.
double baseline_seconds(const Photo& photo) {
    const scree::vision::WatershedDetector baseline({.working_width = 0});
    std::array<double, 3> seconds{};
    for (double& run : seconds) {
        scree::Stopwatch watch;
        benchmark::DoNotOptimize(baseline.detect(photo));
        run = watch.lap();
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[1];
}

// The baseline and how many times as long our run took.
void count_ratio(benchmark::State& state, const Photo& photo, double seconds_per_run) {
    const double baseline = baseline_seconds(photo);
    state.counters["canny_watershed_ms"] = 1e3 * baseline;
    state.counters["ratio"] = seconds_per_run / baseline;
}

void photo_to_files(benchmark::State& state) {
    const auto width = static_cast<int>(state.range(0));
    const scree::test::TempDir dir;
    const Photo photo = ground(width, width * 3 / 4);
    scree::vision::write_png(dir / "photo.png", photo);
    double peak = 0.0;
    scree::Stopwatch watch;
    for (auto _ : state)
        peak = std::max(peak, run_program(dir / "photo.png", dir / "out"));
    count_ratio(state, photo, watch.lap() / static_cast<double>(state.iterations()));
    state.counters["peak_mib"] = peak;
    state.counters["megapixels"] = width * (width * 3 / 4) * 1e-6;
}
BENCHMARK(photo_to_files)
    ->Arg(900)
    ->Arg(4000)
    ->Iterations(5)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void outlines(benchmark::State& state, scree::vision::Method method) {
    const auto width = static_cast<int>(state.range(0));
    const Photo photo = ground(width, width * 3 / 4);
    std::size_t n_rocks = 0;
    scree::Stopwatch watch;
    for (auto _ : state)
        n_rocks = scree::vision::extract_rocks(photo, {.method = method}).rocks.rocks.size();
    count_ratio(state, photo, watch.lap() / static_cast<double>(state.iterations()));
    state.counters["rocks"] = static_cast<double>(n_rocks);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(photo.size()));
}
BENCHMARK_CAPTURE(outlines, learned, scree::vision::Method::Learned)
    ->Arg(900)
    ->Arg(1155)
    ->Iterations(5)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(outlines, classical, scree::vision::Method::Classical)
    ->Arg(900)
    ->Arg(1155)
    ->Iterations(7)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(outlines, thesis, scree::vision::Method::Thesis)
    ->Arg(900)
    ->Iterations(3)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// How many times as fast two threads find the outlines as one does, on a machine with two cores.
void parallel_speed_up(benchmark::State& state, scree::vision::Method method) {
    const auto width = static_cast<int>(state.range(0));
    const Photo photo = ground(width, width * 3 / 4);
    const auto seconds = [&](int n_threads) {
        const scree::ThreadLimit limit(n_threads);
        scree::Stopwatch watch;
        benchmark::DoNotOptimize(scree::vision::extract_rocks(photo, {.method = method}));
        return watch.lap();
    };
    double one = 0.0;
    double two = 0.0;
    for (auto _ : state) {
        one += seconds(1);
        two += seconds(2);
    }
    state.counters["one_thread_ms"] = 1e3 * one / static_cast<double>(state.iterations());
    state.counters["two_threads_ms"] = 1e3 * two / static_cast<double>(state.iterations());
    state.counters["speed_up"] = one / two;
}
BENCHMARK_CAPTURE(parallel_speed_up, learned, scree::vision::Method::Learned)
    ->Arg(900)
    ->Iterations(5)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parallel_speed_up, classical, scree::vision::Method::Classical)
    ->Arg(900)
    ->Iterations(7)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parallel_speed_up, thesis, scree::vision::Method::Thesis)
    ->Arg(900)
    ->Iterations(3)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
