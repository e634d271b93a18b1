#include "vision/learned/tile_plan.h"

#include "vision/learned/outline_network.h"

#include <algorithm>
#include <cassert>

namespace scree::vision {
namespace {

int round_up(int value) {
    return (value + kNetworkStep - 1) / kNetworkStep * kNetworkStep;
}

// Share of the later of two stretches at place x of their overlap.
float handed_over(const Span& earlier, const Span& later, int x) {
    const float overlap = static_cast<float>(earlier.end() - later.begin);
    const float at = (static_cast<float>(x - later.begin) + 0.5F) / overlap;
    return std::clamp(2.0F * at - 0.5F, 0.0F, 1.0F);
}

}  // namespace

std::vector<Span> plan_tiles(int length, int most, int margin) {
    assert(length % kNetworkStep == 0 && most % kNetworkStep == 0);
    assert(most >= 8 * kNetworkStep && most >= 8 * margin);
    if (length <= most)
        return {{0, length}};
    const int overlap = std::max(kNetworkStep, round_up(2 * margin));
    const int most_strides = (length - overlap + most - overlap - 1) / (most - overlap);
    const int stride = round_up((length - overlap + most_strides - 1) / most_strides);
    const int size = stride + overlap;
    const int n = (length - overlap + stride - 1) / stride;
    std::vector<Span> tiles;
    for (int i = 0; i < n; ++i) {
        const int even = static_cast<int>(static_cast<long long>(i) * (length - size) / (n - 1));
        tiles.push_back({even / kNetworkStep * kNetworkStep, size});
    }
    return tiles;
}

std::vector<float> tile_weights(const std::vector<Span>& tiles, std::size_t which) {
    const Span& tile = tiles[which];
    std::vector<float> weights(static_cast<std::size_t>(tile.size), 1.0F);
    for (int x = tile.begin; x < tile.end(); ++x) {
        float& weight = weights[static_cast<std::size_t>(x - tile.begin)];
        if (which > 0 && x < tiles[which - 1].end())
            weight = handed_over(tiles[which - 1], tile, x);
        if (which + 1 < tiles.size() && x >= tiles[which + 1].begin)
            weight *= 1.0F - handed_over(tile, tiles[which + 1], x);
    }
    return weights;
}

}  // namespace scree::vision
