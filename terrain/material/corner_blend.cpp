#include "terrain/material/corner_blend.h"

#include "terrain/material/hat_blend.h"
#include "terrain/material/map_check.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {
namespace {

// A material and the bilinear weight of its cells.
void add_corner(CornerWeights& corners, int slot, float weight) {
    int at = 0;
    while (at < corners.count && corners.slots[static_cast<std::size_t>(at)] != slot)
        ++at;
    const auto place = static_cast<std::size_t>(at);
    if (at == corners.count) {
        corners.slots[place] = slot;
        ++corners.count;
    }
    corners.weights[place] += weight;
}

float faded(const CornerWeights& corners, const FadeTable& fades, std::size_t one) {
    float low = 0.0F;
    float high = 0.0F;
    for (std::size_t k = 0; k < static_cast<std::size_t>(corners.count); ++k) {
        low += corners.slots[k] < corners.slots[one] ? corners.weights[k] : 0.0F;
        high += corners.slots[k] > corners.slots[one] ? corners.weights[k] : 0.0F;
    }
    const auto slot = static_cast<std::size_t>(corners.slots[one]);
    const float others = low + high;
    const float reach = low * fades.low[slot] + high * fades.high[slot];  // fade * others
    if (others <= 0.0F)
        return 1.0F;
    return reach <= 0.0F ? 0.0F : std::max(0.0F, 1.0F - others * others / reach);
}

}  // namespace

FadeTable fade_table(const std::vector<Material>& materials) {
    FadeTable table{slots_of_ids(materials), {}, {}};
    const std::vector<HatBreaks> breaks = hat_breaks(materials);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const auto share = [&](double reach, std::size_t neighbour) {
            const double distance = std::abs(materials[neighbour].id - materials[i].id) / 255.0;
            return static_cast<float>(std::min(1.0, reach / distance));
        };
        const HatBreaks& hat = breaks[i];
        table.low.push_back(i == 0 ? 1.0F : share(hat.b - hat.a, i - 1));
        table.high.push_back(i + 1 == materials.size() ? 1.0F : share(hat.c - hat.b, i + 1));
    }
    return table;
}

CornerWeights corner_weights(const Raster<std::uint8_t>& ids, const FadeTable& fades, float x,
                             float y) {
    const float column = x - 0.5F;
    const float row = y - 0.5F;
    const float left = std::floor(column);
    const float top = std::floor(row);
    const float fx = column - left;
    const float fy = row - top;
    CornerWeights corners;
    for (int k = 0; k < 4; ++k) {
        const float wx = k % 2 == 0 ? 1.0F - fx : fx;
        const float wy = k < 2 ? 1.0F - fy : fy;
        const float cx =
            std::clamp(left + static_cast<float>(k % 2), 0.0F, static_cast<float>(ids.width() - 1));
        const float cy =
            std::clamp(top + static_cast<float>(k / 2), 0.0F, static_cast<float>(ids.height() - 1));
        const int slot = fades.slots[ids(static_cast<int>(cx), static_cast<int>(cy))];
        add_corner(corners, slot, wx * wy);
    }
    const CornerWeights plain = corners;
    float sum = 0.0F;
    std::size_t greatest = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(plain.count); ++k) {
        corners.weights[k] = faded(plain, fades, k);
        sum += corners.weights[k];
        const bool tie =
            plain.weights[k] == plain.weights[greatest] && plain.slots[k] < plain.slots[greatest];
        if (plain.weights[k] > plain.weights[greatest] || tie)
            greatest = k;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(plain.count); ++k)
        corners.weights[k] = sum > 0.0F ? corners.weights[k] / sum : k == greatest ? 1.0F : 0.0F;
    return corners;
}

}  // namespace scree::terrain
