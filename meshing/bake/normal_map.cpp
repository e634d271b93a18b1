#include "meshing/bake/normal_map.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace scree::meshing {
namespace {

constexpr std::size_t kRowsPerTask = 16;

void check_heights(const vision::HeightImage& heights) {
    if (heights.metres.empty())
        fail<InvalidInput>("a normal map needs heights, the raster is empty");
    if (!(heights.metres_per_pixel > 0.0) || !std::isfinite(heights.metres_per_pixel))
        fail<InvalidInput>("the heights' scale is ", heights.metres_per_pixel,
                           " metres per pixel; a normal map needs a positive one");
    if (!std::all_of(heights.metres.begin(), heights.metres.end(),
                     [](float h) { return std::isfinite(h); }))
        fail<InvalidInput>("the heights hold a value that is no number");
}

inline glm::u8vec3 coded(float slope_x, float slope_down) {
    // n = (-dh/dx, dh/d(row), 1) / |...|: green points up the picture, rows count down it.
    const float scale = 127.5F / std::sqrt(1.0F + slope_x * slope_x + slope_down * slope_down);
    const auto byte = [](float v) { return static_cast<std::uint8_t>(static_cast<int>(v)); };
    return {byte(128.0F - slope_x * scale), byte(128.0F + slope_down * scale),
            byte(128.0F + scale)};
}

SCREE_MULTIVERSION void code_inner(const float* row, const float* above, const float* below,
                                   int width, float across, float down, glm::u8vec3* out) {
    for (int x = 1; x < width - 1; ++x)
        out[x] = coded((row[x + 1] - row[x - 1]) * across, (below[x] - above[x]) * down);
}

// Indices before and after one of an axis, and how many pixels lie between them.
struct Neighbours {
    int before = 0;
    int after = 0;
    float distance = 2.0F;
};

Neighbours neighbours(int index, int size, bool wraps) {
    if (wraps)
        return {(index + size - 1) % size, (index + 1) % size, 2.0F};
    const int before = std::max(index - 1, 0);
    const int after = std::min(index + 1, size - 1);
    return {before, after, static_cast<float>(std::max(after - before, 1))};
}

void code_row(const FloatRaster& metres, int y, bool wraps, float per_pixel, glm::u8vec3* out) {
    const int width = metres.width();
    const Neighbours rows = neighbours(y, metres.height(), wraps);
    const float* const above = metres.row(rows.before);
    const float* const below = metres.row(rows.after);
    const float* const row = metres.row(y);
    const float down = per_pixel / rows.distance;
    code_inner(row, above, below, width, 0.5F * per_pixel, down, out);
    for (const int x : {0, width - 1}) {
        const Neighbours columns = neighbours(x, width, wraps);
        out[x] = coded((row[columns.after] - row[columns.before]) * per_pixel / columns.distance,
                       (below[x] - above[x]) * down);
    }
}

}  // namespace

Photo normal_map(const vision::HeightImage& heights, const NormalMapOptions& options) {
    check(options);
    check_heights(heights);
    Photo map(heights.metres.width(), heights.metres.height());
    const auto per_pixel = static_cast<float>(options.strength / heights.metres_per_pixel);
    parallel_for_each_index(
        0, static_cast<std::size_t>(map.height()), kRowsPerTask, [&](std::size_t y) {
            const int row = static_cast<int>(y);
            code_row(heights.metres, row, options.wraps, per_pixel, map.row(row));
        });
    return map;
}

}  // namespace scree::meshing
