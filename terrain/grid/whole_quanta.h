#pragma once

#include "base/raster.h"

namespace scree::terrain {

/// Round displacements to multiples of a quantum, as the sound scheme needs them. What one cell
/// loses is carried to the next that is displaced, row after row, so that the sum is kept to half a
/// quantum; cells without displacement stay without.
/// @param quantum  A power of two, metres; SoundRule::quantum.
void round_to_quanta(FloatRaster& displacement, float quantum);

/// Throw InvalidInput unless the displacement has the ground's size and holds finite values within
/// 1e9 m.
void check_displacement(const FloatRaster& displacement, int width, int height);

}  // namespace scree::terrain
