#pragma once

#include "vision/outline.h"

#include <functional>
#include <optional>
#include <span>

#include <glm/vec2.hpp>

namespace scree::vision {

/// Signed area of a closed polygon, square pixels; positive if its azimuth increases.
double signed_area(std::span<const glm::dvec2> polygon);

/// Centroid of the area of a closed polygon; the mean of its vertices if it has no area.
/// @pre  At least one vertex.
glm::dvec2 area_centroid(std::span<const glm::dvec2> polygon);

/// Mean of the vertices. @pre  At least one vertex.
glm::dvec2 vertex_mean(std::span<const glm::dvec2> polygon);

/// Even-odd test.
bool is_inside(std::span<const glm::dvec2> polygon, glm::dvec2 point);

/// Call `visit(y, from, to)` for every run [from, to) of pixels of a width x height picture whose
/// centres lie inside the polygon, even-odd.
void for_each_inside_run(std::span<const glm::dvec2> polygon, int width, int height,
                         const std::function<void(int y, int from, int to)>& visit);

/// Distances from `centre` at whole degrees to a closed polygon, the nearest crossing if several.
/// @return  Nothing if some ray misses it: the centre lies outside.
std::optional<std::array<float, kRadii>> polygon_radii(std::span<const glm::dvec2> polygon,
                                                       glm::dvec2 centre);

}  // namespace scree::vision
