#include "meshing/bake/ambient_occlusion.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace scree::meshing {
namespace {

constexpr std::size_t kRowsPerTask = 8;

// One look towards the horizon: whole pixels, and one over their true distance in metres.
struct Look {
    int dx = 0;
    int dy = 0;
    float per_distance = 0.0F;
};

using Direction = std::vector<Look>;

// Heights with a margin of `margin` pixels on every side, so that no look leaves the raster.
struct Ground {
    FloatRaster padded;
    int width = 0;
    int height = 0;
    int margin = 0;
};

void check_heights(const vision::HeightImage& heights) {
    if (heights.metres.empty())
        fail<InvalidInput>("ambient occlusion needs heights, the raster is empty");
    if (!(heights.metres_per_pixel > 0.0) || !std::isfinite(heights.metres_per_pixel))
        fail<InvalidInput>("the heights' scale is ", heights.metres_per_pixel,
                           " metres per pixel; ambient occlusion needs a positive one");
    if (!std::all_of(heights.metres.begin(), heights.metres.end(),
                     [](float h) { return std::isfinite(h); }))
        fail<InvalidInput>("the heights hold a value that is no number");
}

// Least whole factor that brings the map under the working size; a map that wraps keeps its
// period, so there the factor must divide both sides.
int reduction(const FloatRaster& metres, const AmbientOcclusionOptions& options) {
    const double ratio = static_cast<double>(metres.size()) / options.working_pixels;
    int factor = std::max(1, static_cast<int>(std::ceil(std::sqrt(ratio))));
    while (options.wraps && (metres.width() % factor != 0 || metres.height() % factor != 0))
        --factor;
    return factor;
}

FloatRaster reduced(const FloatRaster& metres, int factor) {
    const int width = (metres.width() + factor - 1) / factor;
    const int height = (metres.height() + factor - 1) / factor;
    FloatRaster small(width, height);
    parallel_for_each_index(0, static_cast<std::size_t>(height), kRowsPerTask, [&](std::size_t i) {
        const int y = static_cast<int>(i);
        const int y_end = std::min((y + 1) * factor, metres.height());
        for (int x = 0; x < width; ++x) {
            const int x_end = std::min((x + 1) * factor, metres.width());
            float sum = 0.0F;
            for (int v = y * factor; v < y_end; ++v)
                for (int u = x * factor; u < x_end; ++u)
                    sum += metres(u, v);
            small(x, y) = sum / static_cast<float>((y_end - y * factor) * (x_end - x * factor));
        }
    });
    return small;
}

Ground padded(const FloatRaster& metres, int margin, bool wraps) {
    Ground ground{FloatRaster(metres.width() + 2 * margin, metres.height() + 2 * margin),
                  metres.width(), metres.height(), margin};
    const auto source = [wraps](int index, int size) {
        return wraps ? ((index % size) + size) % size : std::clamp(index, 0, size - 1);
    };
    for (int y = 0; y < ground.padded.height(); ++y) {
        const float* const row = metres.row(source(y - margin, metres.height()));
        float* const out = ground.padded.row(y);
        std::copy(row, row + metres.width(), out + margin);
        for (int x = 0; x < margin; ++x) {
            out[x] = row[source(x - margin, metres.width())];
            out[margin + metres.width() + x] = row[source(metres.width() + x, metres.width())];
        }
    }
    return ground;
}

std::vector<Direction> looks(const AmbientOcclusionOptions& options, double reach,
                             double metres_per_pixel) {
    std::vector<Direction> directions(static_cast<std::size_t>(options.directions));
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(k) / options.directions;
        for (int s = 0; s < options.steps; ++s) {
            const double distance = std::pow(reach, static_cast<double>(s) / (options.steps - 1));
            const int dx = static_cast<int>(std::lround(distance * std::cos(azimuth)));
            const int dy = static_cast<int>(std::lround(distance * std::sin(azimuth)));
            const bool repeated = !directions[k].empty() && directions[k].back().dx == dx &&
                                  directions[k].back().dy == dy;
            if (!repeated)
                directions[k].push_back(
                    {dx, dy, static_cast<float>(1.0 / (std::hypot(dx, dy) * metres_per_pixel))});
        }
    }
    return directions;
}

// Raise the tangents of the horizon by one look.
SCREE_MULTIVERSION void raise_horizon(const float* here, const float* there, float per_distance,
                                      int width, float* tangent) {
    for (int x = 0; x < width; ++x)
        tangent[x] = std::max(tangent[x], (there[x] - here[x]) * per_distance);
}

// cos^2 of the horizon whose tangent is t is 1 / (1 + t^2).
SCREE_MULTIVERSION void add_sky(const float* tangent, int width, float* sky) {
    for (int x = 0; x < width; ++x)
        sky[x] += 1.0F / (1.0F + tangent[x] * tangent[x]);
}

FloatRaster sky_share(const Ground& ground, const std::vector<Direction>& directions) {
    FloatRaster sky(ground.width, ground.height);
    const float share = 1.0F / static_cast<float>(directions.size());
    parallel_for(0, static_cast<std::size_t>(ground.height), kRowsPerTask,
                 [&](std::size_t first, std::size_t last) {
                     std::vector<float> tangent(static_cast<std::size_t>(ground.width));
                     for (std::size_t i = first; i < last; ++i) {
                         const int y = static_cast<int>(i);
                         const int m = ground.margin;
                         const float* const here = ground.padded.row(y + m) + m;
                         for (const Direction& direction : directions) {
                             std::fill(tangent.begin(), tangent.end(), 0.0F);
                             for (const Look& look : direction)
                                 raise_horizon(here,
                                               ground.padded.row(y + m + look.dy) + m + look.dx,
                                               look.per_distance, ground.width, tangent.data());
                             add_sky(tangent.data(), ground.width, sky.row(y));
                         }
                         for (int x = 0; x < ground.width; ++x)
                             sky(x, y) *= share;
                     }
                 });
    return sky;
}

// Where a pixel of the full map lies between two of the reduced one.
struct Blend {
    int low = 0;
    int high = 0;
    float share = 0.0F;  // of the high one
};

std::vector<Blend> blends(int n_full, int n_small, int factor, bool wraps) {
    std::vector<Blend> all(static_cast<std::size_t>(n_full));
    for (int i = 0; i < n_full; ++i) {
        const double at = (i + 0.5) / factor - 0.5;
        const int low = static_cast<int>(std::floor(at));
        const auto inside = [&](int k) {
            return wraps ? (k + n_small) % n_small : std::clamp(k, 0, n_small - 1);
        };
        all[static_cast<std::size_t>(i)] = {inside(low), inside(low + 1),
                                            static_cast<float>(at - low)};
    }
    return all;
}

Raster<std::uint8_t> coded(const FloatRaster& sky, int width, int height, int factor, bool wraps) {
    Raster<std::uint8_t> map(width, height);
    const std::vector<Blend> columns = blends(width, sky.width(), factor, wraps);
    const std::vector<Blend> rows = blends(height, sky.height(), factor, wraps);
    parallel_for(0, rows.size(), kRowsPerTask, [&](std::size_t first, std::size_t last) {
        std::vector<float> line(static_cast<std::size_t>(sky.width()));
        for (std::size_t y = first; y < last; ++y) {
            const float* const above = sky.row(rows[y].low);
            const float* const below = sky.row(rows[y].high);
            for (std::size_t x = 0; x < line.size(); ++x)
                line[x] = 255.0F * (above[x] + rows[y].share * (below[x] - above[x]));
            std::uint8_t* const out = map.row(static_cast<int>(y));
            for (std::size_t x = 0; x < columns.size(); ++x) {
                const float low = line[static_cast<std::size_t>(columns[x].low)];
                const float high = line[static_cast<std::size_t>(columns[x].high)];
                const float value = low + columns[x].share * (high - low) + 0.5F;
                out[x] = static_cast<std::uint8_t>(static_cast<int>(std::min(value, 255.0F)));
            }
        }
    });
    return map;
}

}  // namespace

Raster<std::uint8_t> ambient_occlusion(const vision::HeightImage& heights,
                                       const AmbientOcclusionOptions& options) {
    check(options);
    check_heights(heights);
    const FloatRaster& metres = heights.metres;
    const int factor = reduction(metres, options);
    const double reach = std::max(1.0, options.reach_px / factor);
    const int margin = static_cast<int>(std::ceil(reach)) + 1;
    const Ground ground =
        padded(factor == 1 ? metres : reduced(metres, factor), margin, options.wraps);
    const FloatRaster sky =
        sky_share(ground, looks(options, reach, heights.metres_per_pixel * factor));
    return coded(sky, metres.width(), metres.height(), factor, options.wraps);
}

}  // namespace scree::meshing
