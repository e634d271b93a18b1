#pragma once

#include "base/progress.h"
#include "base/raster.h"

#include <string>

namespace scree::vision {

/// What an edge stage says of every pixel. Outline finders read it and do not know who filled it.
///
/// All channels have the photograph's size. A detector fills what it can; a channel it cannot
/// fill stays empty.
struct EdgeField {
    FloatRaster
        boundary;  ///< How likely a rock's border runs through the pixel, 0 to 1. Always filled.
    FloatRaster inside;    ///< How likely the pixel lies on a rock, 0 to 1.
    FloatRaster distance;  ///< Distance to the border relative to the rock's own: 0 there, 1 at its
                           ///< deepest point.
};

/// A way to fill an edge field. Detectors are exchangeable.
class EdgeDetector {
public:
    virtual ~EdgeDetector() = default;

    /// @pre   The photograph has at least one pixel.
    /// @post  Every filled channel has the photograph's size and finite values in [0, 1].
    /// @throw InvalidInput  the photograph is empty.
    /// @throw Cancelled     the listener asked for a stop.
    virtual EdgeField detect(const Photo& photo, Progress* progress = nullptr) const = 0;
};

}  // namespace scree::vision
