#pragma once

#include "base/raster.h"
#include "terrain/contact/underside.h"

namespace scree::terrain {

/// The ground that one object stands on, as it was before the object touched it.
///
/// Soil gives way below an object, so that the ground as it is would never bear it. Kept over the
/// object's window: a cell that the object does not reach into takes the present height, one that
/// it does keeps what it had.
struct Footing {
    CellWindow window;
    FloatRaster heights;  ///< Metres.
};

/// Follow the object to its new window. `heights` are the ground's over the underside's window.
void follow(Footing& footing, const Underside& underside, const FloatRaster& heights);

/// How far the underside has to be raised (negative: lowered) so that its deepest cell reaches
/// `sink_m` below the footing; 0 if there is no cell below it.
/// @pre  follow() was called with this underside.
double raise_to_sink(const Footing& footing, const Underside& underside, double sink_m);

/// The same so that the footing bears `load_n`: every cell answers with `stiffness` (pascals a
/// metre of depth, one value a cell of the window) times its area and its depth.
double raise_to_bear(const Footing& footing, const Underside& underside,
                     const FloatRaster& stiffness, double cell_size, double load_n);

}  // namespace scree::terrain
