#pragma once

#include "base/raster.h"

#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// A closed line through points; pixel (x, y) covers [x, x+1) x [y, y+1).
struct Stroke {
    std::vector<glm::vec2> points;
    glm::u8vec3 colour{0};
};

/// Draw closed lines with round joints, smoothed by how far a pixel's centre lies from the line,
/// in their order: where two cross, the later one lies on top.
///
/// The picture does not depend on the number of threads.
/// @param width  In pixels, more than 0. @pre Points are finite.
void draw_strokes(Photo& picture, std::span<const Stroke> strokes, float width);

}  // namespace scree::vision
