#pragma once

#include "base/raster.h"

#include <cstdint>

namespace scree::vision {

using GreyRaster = Raster<std::uint8_t>;  ///< Stored (gamma-coded) brightness, 0 to 255.

/// Rec. 601 luma of the stored colours (`rocks-and-deformer.md` A.4.1).
GreyRaster grey_of(const Photo& photo);

/// Median over a square of `kernel` pixels; the border repeats outwards.
/// @pre   kernel is odd, at least 1.
/// @throw InvalidInput  the picture is empty.
GreyRaster median_filtered(const GreyRaster& grey, int kernel);

}  // namespace scree::vision
