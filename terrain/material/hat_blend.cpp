#include "terrain/material/hat_blend.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scree::terrain {
namespace {

constexpr double kFullId = 255.0;

double hat_at(const HatBreaks& breaks, double t) {
    if ((breaks.first && t <= breaks.b) || (breaks.last && t >= breaks.b))
        return 1.0;
    return hat(breaks.a, breaks.b, breaks.c, t);
}

}  // namespace

double hat(double a, double b, double c, double t) {
    if (!(t >= a && t <= c))
        return 0.0;
    if (t == b)
        return 1.0;
    return t < b ? (t - a) / (b - a) : (c - t) / (c - b);  // (4.15)
}

std::vector<HatBreaks> hat_breaks(const std::vector<Material>& materials) {
    std::vector<HatBreaks> result;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const bool first = i == 0;
        const bool last = i + 1 == materials.size();
        const HatShape& own = materials[i].hat;
        if (own != HatShape{}) {
            result.push_back({own.start, own.peak, own.end, false, false});
            continue;
        }
        const double peak = materials[i].id / kFullId;
        const double start = first ? peak : materials[i - 1].id / kFullId;
        const double end = last ? peak : materials[i + 1].id / kFullId;
        result.push_back({start, peak, end, first, last});
    }
    return result;
}

void hat_weights(std::span<const HatBreaks> breaks, double t, std::span<double> weights) {
    for (std::size_t i = 0; i < breaks.size(); ++i)
        weights[i] = hat_at(breaks[i], t);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (sum > 0.0) {
        for (double& weight : weights)
            weight /= sum;
        return;
    }
    const auto nearest = std::min_element(breaks.begin(), breaks.end(),
                                          [t](const HatBreaks& one, const HatBreaks& other) {
                                              return std::abs(one.b - t) < std::abs(other.b - t);
                                          });
    if (nearest != breaks.end())
        weights[static_cast<std::size_t>(nearest - breaks.begin())] = 1.0;
}

double filtered_id(const Raster<std::uint8_t>& ids, double x, double y) {
    const double column = std::clamp(x - 0.5, 0.0, ids.width() - 1.0);
    const double row = std::clamp(y - 0.5, 0.0, ids.height() - 1.0);
    const int x0 = static_cast<int>(column);
    const int y0 = static_cast<int>(row);
    const int x1 = std::min(x0 + 1, ids.width() - 1);
    const int y1 = std::min(y0 + 1, ids.height() - 1);
    const double fx = column - x0;
    const double fy = row - y0;
    const double top = ids(x0, y0) * (1.0 - fx) + ids(x1, y0) * fx;
    const double bottom = ids(x0, y1) * (1.0 - fx) + ids(x1, y1) * fx;
    return (top * (1.0 - fy) + bottom * fy) / kFullId;
}

}  // namespace scree::terrain
