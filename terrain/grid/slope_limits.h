#pragma once

#include "base/raster.h"
#include "terrain/grid/heightfield.h"
#include "terrain/grid/soil_field.h"

namespace scree::terrain {

using DoubleRaster = Raster<double>;

/// How far heights may differ over each face between two neighbouring cells, metres, none
/// negative. Ground is at rest when no face exceeds its limit.
///
/// A face belongs to its cell with the lower index; entries of the last column (x) and the last
/// row (z) have no face and are not read.
struct SlopeLimits {
    FloatRaster rise_x;  ///< Greatest height(x + 1, y) - height(x, y).
    FloatRaster fall_x;  ///< Greatest height(x, y) - height(x + 1, y).
    FloatRaster rise_z;  ///< Greatest height(x, y + 1) - height(x, y).
    FloatRaster fall_z;  ///< Greatest height(x, y) - height(x, y + 1).
};

/// Limits by the repose of the higher cell of a face, the one that moves
/// (`rocks-and-deformer.md` C.8); with `keep_base` at least what the base itself has (C.7).
///
/// @param soil  The soils of all cells of the base.
SlopeLimits slope_limits(const Heightfield& base, const SoilTile& soil, bool keep_base);

/// By how much the steepest face exceeds its limit, as a slope (height over cell size); 0 at rest.
double greatest_excess(const DoubleRaster& heights, const SlopeLimits& limits, double cell_size);

/// Base plus displacement in double.
DoubleRaster total_heights(const Heightfield& base, const FloatRaster& displacement);

/// Displacement again, by rounding; cells whose total height did not change keep their bits.
void store_displacement(const DoubleRaster& before, const DoubleRaster& heights,
                        const Heightfield& base, FloatRaster& displacement);

/// Throw InvalidInput unless the base is a heightfield and the displacement has its size and only
/// finite numbers.
void check_ground(const Heightfield& base, const FloatRaster& displacement);

/// Throw InvalidInput unless the planes of `soil` have the base's size and hold numbers, none
/// negative.
void check_soil_tile(const Heightfield& base, const SoilTile& soil);

}  // namespace scree::terrain
