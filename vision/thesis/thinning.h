#pragma once

#include "base/raster.h"

namespace scree::vision {

/// Thin to lines one pixel wide without breaking them (Guo and Hall's two-subiteration scheme).
/// Pixels beyond the picture count as off; on-pixels of the result are 1.
Mask thinned(const Mask& edges);

}  // namespace scree::vision
