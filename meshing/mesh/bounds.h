#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <glm/vec3.hpp>

namespace scree::meshing {

/// Least axis-aligned box that holds every vertex.
struct Box {
    glm::vec3 min{0.0F};
    glm::vec3 max{0.0F};
};

/// @throw InvalidInput  the mesh has no vertex.
Box bounding_box(const TriMesh& mesh);

/// Distance from the mesh's origin to its farthest vertex, rounded up so that every vertex lies
/// inside. Zero for a mesh without vertices.
float outer_radius(const TriMesh& mesh);

/// Distance from the mesh's origin to its nearest surface point, rounded down; for a closed mesh
/// about the origin the radius of the largest sphere inside. Zero for a mesh without triangles.
float inner_radius(const TriMesh& mesh);

}  // namespace scree::meshing
