#pragma once

#include "testdata/scene_layout.h"

#include <array>

namespace scree::test {

/// Light that the heap sends straight up, linear, one raster a channel, on the canvas.
std::array<FloatRaster, 3> light_heap(const Heap& heap, const SceneOptions& options);

/// Lens, sensor and software: canvas light to the bytes of the picture.
Photo develop(const std::array<FloatRaster, 3>& light, const SceneOptions& options);

/// Leave the traces of JPEG compression (8 x 8 blocks, halved colour) in a picture.
void compress(Photo& photo, int quality);

}  // namespace scree::test
