#pragma once

#include "vision/edge_field.h"

namespace scree::vision {

/// The usual size of the rocks around every pixel: the mean of the binary logarithm of their
/// diameters in pixels, each rock counted once whatever its size, over a Gaussian neighbourhood of
/// 48 px. A pixel on a rock tells its diameter as twice its distance to the border in pixels over
/// the distance channel. At least 2, that is 4 px; 5 where there is no rock far and wide.
///
/// Worked out in cells of 8 x 8 px.
/// @pre  All channels are filled.
FloatRaster local_rock_sizes(const EdgeField& field);

}  // namespace scree::vision
