#pragma once

#include "base/options.h"
#include "meshing/mesh/adjacency.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace scree::meshing {

/// How curvature becomes a number in [-1, 1] (`mesh-erosion.md` 2.2).
enum class CurvatureScale {
    DownscaleOnly,  ///< Divided by its greatest value if that is above 1; depends on the units.
    Always,         ///< Divided by its greatest value; independent of the units.
    Percentile,     ///< As Always, by the value that only few exceed; those are clamped.
};

/// How curvature becomes a number in [0, 1] (`mesh-erosion.md` 2.3).
enum class UnsignedScale {
    Automatic,  ///< MinMax on a body with real hollows, else Symmetric.
    MinMax,     ///< The least value becomes 0: as printed; flats of a convex body stand still.
    Symmetric,  ///< Flats become 1/2.
};

inline constexpr std::string_view kCurvatureScaleNames[] = {"downscale-only", "always",
                                                            "percentile"};
inline constexpr std::string_view kUnsignedScaleNames[] = {"automatic", "min-max", "symmetric"};

constexpr std::span<const std::string_view> names_of(CurvatureScale) {
    return kCurvatureScaleNames;
}
constexpr std::span<const std::string_view> names_of(UnsignedScale) {
    return kUnsignedScaleNames;
}

/// Least and greatest curvature of one object, without its rims; 0 and 0 if it is all rim.
struct CurvatureRange {
    float low = 0.0F;
    float high = 0.0F;

    float greatest() const { return std::max(std::abs(low), std::abs(high)); }
};

CurvatureRange curvature_range(std::span<const float> curvature, const Adjacency& adjacency);

/// The absolute value that the share `quantile` of the vertices inside the rims stays under.
/// @throw InvalidInput  the quantile is not in [0, 1].
float curvature_quantile(std::span<const float> curvature, const Adjacency& adjacency,
                         double quantile);

/// What to multiply curvature with so that it lies in [-1, 1]; see CurvatureScale.
/// @param greatest  Of the absolute values; for Percentile the quantile.
/// @param floor     With Always and Percentile nothing is stretched if `greatest` is below it.
float signed_factor(float greatest, CurvatureScale scale, float floor = 0.0F);

/// Curvature times the factor, clamped to [-1, 1].
inline float scale_signed(float curvature, float factor) {
    return std::clamp(curvature * factor, -1.0F, 1.0F);
}

/// Curvature in [0, 1], protrusions highest; 1/2 everywhere if it is the same everywhere.
std::vector<float> scale_unsigned(std::span<const float> curvature, const CurvatureRange& range,
                                  UnsignedScale scale = UnsignedScale::Automatic);

}  // namespace scree::meshing
