#pragma once

#include "terrain/grid/heightfield.h"

namespace scree::terrain {

/// Distance of every cell's centre to that of the nearest cell at or below the water level,
/// metres; infinite if there is none. Exact, in time proportional to the cells.
FloatRaster water_distance(const Heightfield& ground, double water_level);

}  // namespace scree::terrain
