#pragma once

#include "base/raster.h"

namespace scree::test {

/// A Gaussian of standard deviation `sigma` pixels; beyond the border its values go on.
FloatRaster blurred(const FloatRaster& source, double sigma);

}  // namespace scree::test
