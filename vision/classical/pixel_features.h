#pragma once

#include "base/raster.h"
#include "vision/classical/light_pyramid.h"

#include <memory>
#include <vector>

namespace scree::vision {

/// What the coarser level said, brought to the size of this one with the margin of its planes.
/// Empty at the coarsest level.
using Context = std::vector<FloatRaster>;

/// The measured values of some rows of a level, as planes whose rows lie one after the other.
class FeatureStrip {
public:
    /// Measure rows [first, last) of the level.
    FeatureStrip(const LightLevel& level, const Context& context, int first, int last);
    ~FeatureStrip();

    /// Number of values a pixel; depends only on whether there is a context.
    int count() const;
    /// The values of feature `i` along row `y` of the level, from column 0 on.
    const float* row(int i, int y) const;

private:
    struct Planes;
    std::unique_ptr<Planes> planes_;
};

}  // namespace scree::vision
