#pragma once

#include "vision/outline.h"

#include <glm/vec2.hpp>

namespace scree::vision {

/// Most pixels of a working picture: what a very tall picture is held to instead of its width.
inline constexpr double kGreatestWorkingPixels = 16e6;

/// Size of a picture scaled to `width` with its aspect ratio kept to a pixel; a width of 0 leaves
/// it. Smaller if that would exceed kGreatestWorkingPixels. @pre  The picture has a pixel.
glm::ivec2 working_size(glm::ivec2 size, int width);

/// Scale a photograph: by area when it shrinks, bilinearly when it grows.
Photo scaled_photo(const Photo& photo, glm::ivec2 size);

/// Scale a mask: a pixel is on if any pixel of the old one that it touches is, so lines stay whole.
Mask scaled_mask(const Mask& mask, glm::ivec2 size);

/// The outline in a picture that is `scale` times as large in x and y.
Outline scaled_outline(const Outline& outline, glm::dvec2 scale);

}  // namespace scree::vision
