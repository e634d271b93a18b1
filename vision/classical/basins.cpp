#include "vision/classical/basins.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>

namespace scree::vision {
namespace {

using Links = Raster<std::int32_t>;

// Index of the pixel that (x, y) flows to; its own if it is a sink.
std::int32_t lowest_neighbour(const FloatRaster& relief, const Mask& mask, int x, int y) {
    const int width = relief.width();
    int best = y * width + x;
    float low = relief(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(relief.height() - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
            const int index = v * width + u;
            const float height = relief(u, v);
            if (mask(u, v) != 0 && (height < low || (height == low && index < best))) {
                low = height;
                best = index;
            }
        }
    return best;
}

Links flow(const FloatRaster& relief, const Mask& mask) {
    Links links(relief.width(), relief.height(), kNoBasin);
    parallel_for_each_index(0, static_cast<std::size_t>(relief.height()), 32, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < relief.width(); ++x)
            if (mask(x, y) != 0)
                links(x, y) = lowest_neighbour(relief, mask, x, y);
    });
    return links;
}

}  // namespace

BasinMap find_basins(const FloatRaster& relief, const Mask& mask) {
    if (relief.width() != mask.width() || relief.height() != mask.height())
        fail<InvalidInput>("the relief is ", relief.width(), " x ", relief.height(),
                           " but its mask ", mask.width(), " x ", mask.height());
    BasinMap basins{flow(relief, mask), 0};
    std::int32_t* link = basins.labels.data();
    const auto n = static_cast<std::int32_t>(basins.labels.size());
    for (std::int32_t i = 0; i < n; ++i) {  // point every pixel at its sink
        if (link[i] == kNoBasin)
            continue;
        std::int32_t sink = i;
        while (link[sink] != sink)
            sink = link[sink];
        for (std::int32_t at = i; at != sink;) {
            const std::int32_t next = link[at];
            link[at] = sink;
            at = next;
        }
    }
    std::vector<std::int32_t> number(static_cast<std::size_t>(n), kNoBasin);
    for (std::int32_t i = 0; i < n; ++i)
        if (link[i] == i)
            number[static_cast<std::size_t>(i)] = basins.count++;
    for (std::int32_t i = 0; i < n; ++i)
        if (link[i] != kNoBasin)
            link[i] = number[static_cast<std::size_t>(link[i])];
    return basins;
}

}  // namespace scree::vision
