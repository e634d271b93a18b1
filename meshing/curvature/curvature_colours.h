#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <span>
#include <vector>

namespace scree::meshing {

/// Blue for -1, green for 0, red for 1, straight lines between (`mesh-erosion.md` 2.4). Values
/// outside are clamped. Coded bytes, as a screen shows them.
glm::u8vec3 curvature_colour(float scaled);

/// The colours of all vertices: curvature times the factor.
std::vector<glm::u8vec3> curvature_colours(std::span<const float> curvature, float factor);

}  // namespace scree::meshing
