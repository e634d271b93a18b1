#pragma once

#include "terrain/view/terrain_frame.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// A box along the axes, metres.
struct ViewBox {
    glm::vec3 low{0.0F};
    glm::vec3 high{0.0F};

    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// Bounds of the objects in the world; `fallback` where there are none.
/// @throw InvalidInput  an object has no mesh or a place that is no number.
ViewBox bounds_of(const std::vector<TerrainObject>& objects, const glm::vec3& fallback);

/// Clip space from the world, near and far planes about `scene`.
/// @throw InvalidInput  the eye stands at its target, or a number is not finite.
glm::mat4 clip_from_world(const TerrainCamera& camera, double aspect, const ViewBox& scene);

/// The objects' shadow map, 0 to 1 along all axes: covers `casters` and reaches down to `ground`.
glm::mat4 shadow_from_world(const glm::vec3& sun, const ViewBox& casters, const ViewBox& ground);

/// The objects seen from straight below, 0 to 1 over their bounds: x, z, and height.
glm::mat4 under_from_world(const ViewBox& objects);

/// Unit vector towards the sun. @throw InvalidInput  it is not above the horizon.
glm::vec3 sun_direction(const TerrainLight& light);

}  // namespace scree::terrain
