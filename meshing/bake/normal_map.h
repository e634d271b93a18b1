#pragma once

#include "base/options.h"
#include "base/raster.h"
#include "vision/image_io.h"

namespace scree::meshing {

struct NormalMapOptions {
    double strength = 1.0;  ///< Slopes are multiplied by it; 1 is true to scale.
    bool wraps = false;     ///< The map repeats: borders take their neighbours from the far side.
};

template <class Visitor>
void describe(NormalMapOptions& o, Visitor&& field) {
    field("strength", o.strength,
          {.min = 0.01, .max = 100, .help = "factor on slopes; 1 is true to scale"});
    field("wraps", o.wraps, {.help = "the map repeats in both directions"});
}

/// Tangent-space normal map of heights, in glTF's convention.
///
/// Red is the normal's share along the picture's columns (to the right), green the share towards
/// the top of the picture, blue the share out of the surface; a byte b stands for b/127.5 - 1, so
/// flat ground is (128, 128, 255). The colours are linear, not sRGB. Slopes are central
/// differences of true metres, one-sided at borders that do not wrap.
/// @pre   Heights are finite and `metres_per_pixel` is positive.
/// @throw InvalidInput  there are no pixels, a height is no number or the scale is unknown.
/// @throw InvalidOption a value is out of its range.
Photo normal_map(const vision::HeightImage& heights, const NormalMapOptions& options = {});

}  // namespace scree::meshing
