#pragma once

#include "base/raster.h"
#include "vision/thesis/thesis_options.h"

namespace scree::vision {

/// Thresholds of the hysteresis, in the units of the accumulation image.
struct Thresholds {
    double high = 0.0;
    double low = 0.0;
};

/// Choose t_H by the rule of the options and t_L as its share (A.4.3, AMB-04).
/// @throw InvalidInput  the picture is empty.
Thresholds choose_thresholds(const FloatRaster& accumulation, const ThesisOptions& options);

/// Edges: pixels above `high`, and those above `low` that are 8-connected to one through others.
Mask hysteresis(const FloatRaster& accumulation, const Thresholds& thresholds);

}  // namespace scree::vision
