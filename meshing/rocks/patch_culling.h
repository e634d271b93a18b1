#pragma once

#include "meshing/rocks/rock_patch.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace scree::meshing {

/// Bounding spheres of a patch's instances, ready to be tested against many views.
struct InstanceSpheres {
    std::vector<float> x, y, z;  ///< Centres, metres.
    std::vector<float> radius;   ///< Metres.
};

/// @throw InvalidInput  the patch names a mesh or prototype that is not there.
InstanceSpheres instance_spheres(const RockPatch& patch, const std::vector<RockMesh>& rocks);

/// Indices of the instances whose sphere reaches into the view, rising.
/// @param clip_from_world  glTF's and OpenGL's clip space: x, y and z in [-w, w].
std::vector<std::uint32_t> visible_instances(const InstanceSpheres& spheres,
                                             const glm::mat4& clip_from_world);

}  // namespace scree::meshing
