#include "meshing/curvature/curvature_scale.h"

#include "base/error.h"

#include <cstddef>

namespace scree::meshing {
namespace {

// Hollows shallower than this share of the greatest curvature are noise of a convex body.
constexpr float kRealHollow = 0.05F;

void check_sizes(std::span<const float> curvature, const Adjacency& adjacency) {
    if (curvature.size() != adjacency.n_vertices())
        fail<InvalidInput>("there are ", curvature.size(), " curvatures for ",
                           adjacency.n_vertices(), " vertices");
}

}  // namespace

CurvatureRange curvature_range(std::span<const float> curvature, const Adjacency& adjacency) {
    check_sizes(curvature, adjacency);
    CurvatureRange range;
    bool first = true;
    for (std::size_t v = 0; v < curvature.size(); ++v) {
        if (adjacency.rim[v] != 0)
            continue;
        range.low = first ? curvature[v] : std::min(range.low, curvature[v]);
        range.high = first ? curvature[v] : std::max(range.high, curvature[v]);
        first = false;
    }
    return range;
}

float curvature_quantile(std::span<const float> curvature, const Adjacency& adjacency,
                         double quantile) {
    check_sizes(curvature, adjacency);
    if (!(quantile >= 0.0 && quantile <= 1.0))
        fail<InvalidInput>("the quantile is ", quantile, ", must be in [0, 1]");
    std::vector<float> sizes;
    for (std::size_t v = 0; v < curvature.size(); ++v)
        if (adjacency.rim[v] == 0)
            sizes.push_back(std::abs(curvature[v]));
    if (sizes.empty())
        return 0.0F;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::llround(quantile * static_cast<double>(sizes.size() - 1)));
    std::nth_element(sizes.begin(), sizes.begin() + rank, sizes.end());
    return sizes[static_cast<std::size_t>(rank)];
}

float signed_factor(float greatest, CurvatureScale scale, float floor) {
    const bool stretch = scale != CurvatureScale::DownscaleOnly;
    const bool divide = stretch ? greatest > floor : greatest > 1.0F;
    return divide ? 1.0F / greatest : 1.0F;
}

std::vector<float> scale_unsigned(std::span<const float> curvature, const CurvatureRange& range,
                                  UnsignedScale scale) {
    const float greatest = range.greatest();
    const bool has_hollows = range.low < -kRealHollow * greatest;
    const bool min_max =
        scale == UnsignedScale::MinMax || (scale == UnsignedScale::Automatic && has_hollows);
    const float low = min_max ? range.low : -greatest;
    const float high = min_max ? range.high : greatest;
    std::vector<float> result(curvature.size(), 0.5F);
    if (!(high > low))
        return result;
    const float factor = 1.0F / (high - low);
    for (std::size_t v = 0; v < curvature.size(); ++v)
        result[v] = std::clamp((curvature[v] - low) * factor, 0.0F, 1.0F);
    return result;
}

}  // namespace scree::meshing
