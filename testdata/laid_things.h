#pragma once

#include "base/raster.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::test {

/// A hand held into a photograph, palm down.
struct HandOptions {
    glm::dvec2 knuckles{256.0, 256.0};     ///< Where the middle finger begins, px.
    double finger = 16.0;                  ///< Half the width of a finger, px.
    double azimuth = -1.6;                 ///< Where the fingers point, radians from +x towards +y.
    double spread = 0.18;                  ///< Between fingers, radians.
    glm::dvec3 skin{205.0, 150.0, 120.0};  ///< 8-bit sRGB where light falls straight.
};

/// Draw it over `photo`, with its shadow.
/// @return 255 where the hand is.
Mask lay_hand(Photo& photo, const HandOptions& options);

/// A scale bar: white, black fields along one side, ticks along the other.
struct RulerOptions {
    glm::dvec2 centre{256.0, 256.0};    ///< px.
    glm::dvec2 half_size{120.0, 18.0};  ///< px, along and across.
    double azimuth = 0.5;               ///< Radians from +x towards +y.
};

/// Lay it on `photo`. @return 255 where it lies.
Mask lay_ruler(Photo& photo, const RulerOptions& options);

}  // namespace scree::test
