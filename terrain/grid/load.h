#pragma once

#include "base/raster.h"
#include "terrain/grid/cell_window.h"

namespace scree::terrain {

/// How one object, or several at once, press on the ground during one frame.
///
/// All rasters have the window's size. Forces are in grid units (`rocks-and-deformer.md` C.9):
/// a force of 1 on soil of mobility 1 carries one cell size of height through a face per
/// iteration, before the limiter.
struct Load {
    CellWindow window;
    FloatRaster force_x;    ///< Along +X.
    FloatRaster force_z;    ///< Along +Z.
    FloatRaster underside;  ///< Height of the objects' lowest surface above a cell, metres;
                            ///< +infinity where there is none. No push digs below it.
};

}  // namespace scree::terrain
