#pragma once

#include "base/raster.h"
#include "vision/classify/ground_classes.h"

#include <cstdint>

namespace scree::test {

/// Colours before the camera, 0 to 1.
using ColourRaster = Raster<glm::vec3>;

/// Ground of one class that fills a picture: colour, grain, relief and light are drawn from the
/// seed. Same class, size and seed, same bytes for any number of threads.
ColourRaster draw_ground(vision::GroundClass kind, int width, int height, std::uint64_t seed);

/// A photograph of several grounds side by side, with the class of every pixel.
struct GroundMosaic {
    Photo photo;
    Raster<std::uint8_t> classes;  ///< vision::GroundClass.
};

/// Three to six regions with wavy borders under one light and camera.
/// @throw InvalidOption  a side is not in [64, 2048].
GroundMosaic make_ground_mosaic(int width, int height, std::uint64_t seed);

}  // namespace scree::test
