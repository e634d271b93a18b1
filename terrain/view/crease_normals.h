#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// A corner of a triangle, ready for drawing.
struct ShadedCorner {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F, 1.0F, 0.0F};
};

/// The corners of all triangles, three each. Normals are the mesh's; where it has none, each is the
/// mean by area of the triangles round the corner that bend by less than `crease_deg` from its own.
/// @throw InvalidInput  the mesh is broken, see check_mesh().
std::vector<ShadedCorner> shaded_corners(const meshing::TriMesh& mesh, double crease_deg = 40.0);

}  // namespace scree::terrain
