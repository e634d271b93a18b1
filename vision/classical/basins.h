#pragma once

#include "base/raster.h"

#include <cstdint>

namespace scree::vision {

inline constexpr std::int32_t kNoBasin = -1;

/// Catchment basins of a relief: every pixel flows to its lowest neighbour until it can sink no
/// further, and belongs to the pixel where it stops.
struct BasinMap {
    Raster<std::int32_t> labels;  ///< 0 ... count - 1, or kNoBasin outside the mask.
    int count = 0;
};

/// Part the masked pixels into basins (eight neighbours). Equal heights sink towards the earlier
/// pixel in row order, so a plain falls into few basins and the outcome is always the same.
///
/// @pre   Relief and mask have the same size; every height is finite.
/// @throw InvalidInput  the sizes differ.
BasinMap find_basins(const FloatRaster& relief, const Mask& mask);

}  // namespace scree::vision
