#pragma once

#include "base/raster.h"

namespace scree::vision {

/// What a photograph says of relief too fine for outlines: dark crevices and borders lie low, what
/// is brighter than its surroundings lies high.
///
/// Two planes are looked at, both smoothed over a tenth of a rock's radius: the logarithm of the
/// luma less its mean over two radii, and the edge field's boundary. Each is divided by its own
/// spread over the picture, so that neither exposure nor contrast matters; their difference is
/// bent into (-1, 1) by x / sqrt(1 + x^2). docs/displacement.md has the figures behind the form.
/// @param boundary     Of the edge field; empty if it is not known, then the luma alone counts.
/// @param rock_radius  Typical radius of the picture's rocks, px; what is coarser is left out.
/// @return One value a pixel in (-1, 1), about 0 on average; all 0 where the planes are even.
/// @throw InvalidInput  the photograph is empty, the boundary has another size or holds values that
///                      are no numbers, or the radius is not in [1, 1e5].
FloatRaster relief_signal(const Photo& photo, const FloatRaster& boundary, double rock_radius);

}  // namespace scree::vision
