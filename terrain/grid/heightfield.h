#pragma once

#include "base/raster.h"

namespace scree::terrain {

/// Heights on a grid of square cells, metres, +Y up.
///
/// Column x runs along world +X, row y along world +Z. Cell (x, y) covers
/// [x, x + 1) * cell_size by [y, y + 1) * cell_size, its height is that of its centre; the corner
/// of cell (0, 0) is the world's origin.
struct Heightfield {
    FloatRaster heights;     ///< Metres.
    double cell_size = 1.0;  ///< Edge of a cell, metres.
};

/// Throw InvalidInput unless it has at least 2 x 2 cells, a positive cell size and finite heights.
void check_heightfield(const Heightfield& field);

/// Height at a world position, bilinear between cell centres, the rim carried outwards; metres.
double height_at(const Heightfield& field, double x, double z);

}  // namespace scree::terrain
