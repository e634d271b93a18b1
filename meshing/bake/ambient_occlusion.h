#pragma once

#include "base/options.h"
#include "base/raster.h"
#include "vision/image_io.h"

#include <cstdint>

namespace scree::meshing {

struct AmbientOcclusionOptions {
    int directions = 8;           ///< Azimuths in which the horizon is looked for.
    int steps = 10;               ///< Looks per direction, ever further apart.
    double reach_px = 64.0;       ///< Farthest look, pixels of the map.
    double working_pixels = 3e6;  ///< Larger maps are worked on reduced by a whole factor.
    bool wraps = false;           ///< The map repeats in both directions.
};

template <class Visitor>
void describe(AmbientOcclusionOptions& o, Visitor&& field) {
    field("directions", o.directions, {.min = 4, .max = 64, .help = "azimuths of the horizon"});
    field("steps", o.steps, {.min = 2, .max = 64, .help = "looks per azimuth"});
    field("reach-px", o.reach_px, {.min = 2, .max = 1024, .unit = "px", .help = "farthest look"});
    field("working-pixels", o.working_pixels,
          {.min = 1e4, .max = 1e9, .unit = "px", .help = "larger maps are reduced first"});
    field("wraps", o.wraps, {.help = "the map repeats in both directions"});
}

/// Share of a uniform sky that lights a level facet at each pixel, 255 for all of it.
///
/// With horizon angles w_k in N azimuths the share is the mean of cos^2(w_k): exact for the
/// cosine-weighted sky as N grows. Horizons are looked for at distances that grow geometrically
/// from one pixel to the reach; heights beyond a border that does not wrap repeat the border.
/// Maps above `working_pixels` are averaged down by a whole factor and the result interpolated
/// back. Slopes tilt no facet: that is the normal map's part.
/// @pre   Heights are finite and `metres_per_pixel` is positive.
/// @throw InvalidInput  there are no pixels, a height is no number or the scale is unknown.
/// @throw InvalidOption a value is out of its range.
Raster<std::uint8_t> ambient_occlusion(const vision::HeightImage& heights,
                                       const AmbientOcclusionOptions& options = {});

}  // namespace scree::meshing
