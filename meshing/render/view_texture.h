#pragma once

#include "base/raster.h"

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// The photograph made smaller by a whole factor: finer detail than the samples only flickers.
/// Every pixel is the mean of the coded values of a square.
Photo shrunk_photo(const Photo& photo, int factor);

/// Linear light at texture coordinates, bilinear, the rim repeated.
/// @pre  The photograph is not empty.
glm::vec3 light_at(const Photo& photo, const glm::vec2& texcoord);

/// Linear light 0 to 1 as an sRGB-coded byte; values outside are clamped.
std::uint8_t coded_byte(float light);

}  // namespace scree::meshing
