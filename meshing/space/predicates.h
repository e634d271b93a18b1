#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// On which side of the plane through a, b, c the point d lies: 1 in front (where a, b, c run
/// counter-clockwise), -1 behind, 0 on it. Exact for all finite coordinates.
///
/// Computed in double with a bound on its error; where that cannot tell, with rationals.
int orientation(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);

/// 1 if a, b, c run counter-clockwise, -1 if clockwise, 0 if they lie on a line. Exact.
int orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c);

}  // namespace scree::meshing
