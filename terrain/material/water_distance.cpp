#include "terrain/material/water_distance.h"

#include "base/parallel.h"

#include <cmath>
#include <limits>
#include <vector>

namespace scree::terrain {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Along the columns: cells to the nearest wet one of the same column.
void measure_column(const Heightfield& ground, double level, int x, Raster<double>& rows) {
    const int height = ground.heights.height();
    double steps = kFar;
    for (int y = 0; y < height; ++y) {
        steps = double{ground.heights(x, y)} <= level ? 0.0 : steps + 1.0;
        rows(x, y) = steps;
    }
    steps = kFar;
    for (int y = height; y-- > 0;) {
        steps = rows(x, y) == 0.0 ? 0.0 : steps + 1.0;
        rows(x, y) = std::min(rows(x, y), steps);
    }
}

// Along a row: the lower envelope of the parabolas (x - q)^2 + g(q)^2.
void measure_row(const double* g, int width, double cell_size, float* out) {
    std::vector<int> tops;
    std::vector<double> from;  // where each parabola becomes the lowest
    for (int q = 0; q < width; ++q) {
        if (g[q] == kFar)
            continue;
        double start = -kFar;
        while (!tops.empty()) {
            const int p = tops.back();
            start = (g[q] * g[q] + double{1} * q * q - g[p] * g[p] - double{1} * p * p) /
                    (2.0 * (q - p));
            if (start > from.back())
                break;
            tops.pop_back();
            from.pop_back();
            start = -kFar;
        }
        tops.push_back(q);
        from.push_back(start);
    }
    std::size_t k = 0;
    for (int x = 0; x < width; ++x) {
        if (tops.empty()) {
            out[x] = std::numeric_limits<float>::infinity();
            continue;
        }
        while (k + 1 < tops.size() && from[k + 1] <= x)
            ++k;
        const double across = x - tops[k];
        const double along = g[tops[k]];
        out[x] = static_cast<float>(std::sqrt(across * across + along * along) * cell_size);
    }
}

}  // namespace

FloatRaster water_distance(const Heightfield& ground, double water_level) {
    const int width = ground.heights.width();
    const int height = ground.heights.height();
    Raster<double> rows(width, height);
    parallel_for_each_index(0, static_cast<std::size_t>(width), 64, [&](std::size_t x) {
        measure_column(ground, water_level, static_cast<int>(x), rows);
    });
    FloatRaster distance(width, height);
    parallel_for_each_index(0, static_cast<std::size_t>(height), 16, [&](std::size_t y) {
        measure_row(rows.row(static_cast<int>(y)), width, ground.cell_size,
                    distance.row(static_cast<int>(y)));
    });
    return distance;
}

}  // namespace scree::terrain
