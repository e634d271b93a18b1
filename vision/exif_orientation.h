#pragma once

#include "base/raster.h"

namespace scree::vision {

/// The picture as it was seen, from how it is stored and EXIF's orientation (1 to 8; any other
/// value leaves it as it is).
Photo upright(Photo stored, int orientation);

}  // namespace scree::vision
