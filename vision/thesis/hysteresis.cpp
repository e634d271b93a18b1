#include "vision/thesis/hysteresis.h"

#include "base/error.h"

#include <algorithm>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {
namespace {

// The value below which the given share of the values lies; 0 for no values.
double quantile(std::vector<float> values, double share) {
    if (values.empty())
        return 0.0;
    const auto last = static_cast<double>(values.size() - 1);
    const auto rank = static_cast<std::ptrdiff_t>(share * last);
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

double high_threshold(const FloatRaster& accumulation, const ThesisOptions& o) {
    std::vector<float> values(accumulation.begin(), accumulation.end());
    switch (o.threshold) {
        case ThresholdRule::BrightShare:
            return quantile(std::move(values), 1.0 - o.bright_share);
        case ThresholdRule::FirstQuartile:
            return quantile(std::move(values), 0.25);
        case ThresholdRule::ThirdQuartileNonzero:
            std::erase(values, 0.0F);
            return quantile(std::move(values), 0.75);
        default:
            return o.fixed_threshold;
    }
}

}  // namespace

Thresholds choose_thresholds(const FloatRaster& accumulation, const ThesisOptions& options) {
    check_thesis(options);
    if (accumulation.empty())
        fail<InvalidInput>("an accumulation image without pixels has no thresholds");
    const double high = std::max(options.least_threshold, high_threshold(accumulation, options));
    return {high, high * options.low_share};
}

Mask hysteresis(const FloatRaster& accumulation, const Thresholds& thresholds) {
    Mask edges(accumulation.width(), accumulation.height());
    std::vector<glm::ivec2> open;
    for (int y = 0; y < edges.height(); ++y)
        for (int x = 0; x < edges.width(); ++x) {
            if (edges(x, y) != 0 || !(accumulation(x, y) > thresholds.high))
                continue;
            edges(x, y) = 1;
            open.emplace_back(x, y);
            while (!open.empty()) {
                const glm::ivec2 p = open.back();
                open.pop_back();
                for (int v = std::max(0, p.y - 1); v <= std::min(edges.height() - 1, p.y + 1); ++v)
                    for (int u = std::max(0, p.x - 1); u <= std::min(edges.width() - 1, p.x + 1);
                         ++u)
                        if (edges(u, v) == 0 && accumulation(u, v) > thresholds.low) {
                            edges(u, v) = 1;
                            open.emplace_back(u, v);
                        }
            }
        }
    return edges;
}

}  // namespace scree::vision
