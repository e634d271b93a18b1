#pragma once

#include "testdata/scene_bodies.h"

namespace scree::test {

/// A heap at kOversampling times the picture's resolution, with a margin of kMargin.
struct Heap {
    FloatRaster height;          ///< Canvas pixels above the mean ground.
    Raster<std::int32_t> owner;  ///< Body that is seen, or -1 for the ground.
    Raster<std::int32_t> rock;   ///< The same as if no clutter lay on it.
    FloatRaster ground;          ///< Height of the ground itself.
    std::vector<Body> bodies;
    std::vector<double> laid_area;  ///< Canvas pixels that a body would show were it alone.
};

/// Lay all bodies, one by one, each where it comes to rest lowest among some places tried.
Heap lay_heap(const SceneOptions& options);

/// Labels of what is seen of the rocks, and the pixels of clutter, at the picture's resolution.
struct Visible {
    LabelMap labels;
    Mask ignore;
};
Visible label_heap(const Heap& heap, const SceneOptions& options);

}  // namespace scree::test
