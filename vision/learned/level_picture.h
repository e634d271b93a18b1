#pragma once

#include "base/raster.h"
#include "vision/learned/tile_plan.h"

#include <vector>

namespace scree::vision {

/// A photograph at one scale, ready to be cut into tiles for the network.
struct LevelPicture {
    int width = 0, height = 0;  ///< Without the margin.
    Photo padded;               ///< Mirrored to the right and below to multiples of kNetworkStep.
    FloatRaster mean;    ///< Of the light around each cell of 8 x 8 pixels, one cell more a side.
    FloatRaster spread;  ///< Its standard deviation, likewise.
};

/// Half the size, rounded up; every pixel is the mean of four, the last ones repeated at the end
/// of an odd side.
Photo halved(const Photo& photo);

/// Twice the size, by cubic interpolation.
Photo doubled(const Photo& photo);

/// Pad a photograph and measure its light: mean and spread of the luma over a Gaussian window of
/// 64 px, so that nothing depends on what lies further than 256 px away.
LevelPicture level_picture(const Photo& photo);

/// What the network is given of a tile: (colour - mean) / (spread + 0.04), three planes.
/// @pre  The tile lies in the padded picture and begins at a multiple of 8.
void fill_input(const LevelPicture& level, const Span& columns, const Span& rows,
                std::vector<float>& planes);

}  // namespace scree::vision
