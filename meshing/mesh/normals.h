#pragma once

#include "meshing/mesh/adjacency.h"

#include <vector>

namespace scree::meshing {

/// How much each triangle adds to the normal of its corner.
enum class NormalWeight {
    Sphere,  ///< Cross product over the squared lengths of both edges: exact on a sphere.
    Area,
    Angle,
};

inline constexpr std::string_view kNormalWeightNames[] = {"sphere", "area", "angle"};

constexpr std::span<const std::string_view> names_of(NormalWeight) {
    return kNormalWeightNames;
}

/// Unit normals of all vertices, outwards; (0, 0, 0) where no triangle has an area.
///
/// Runs in parallel, the same numbers for any number of threads (`mesh-erosion.md` 2.1, step 1).
/// @pre  The adjacency is the mesh's own.
std::vector<glm::vec3> vertex_normals(const TriMesh& mesh, const Adjacency& adjacency,
                                      NormalWeight weight = NormalWeight::Sphere);

/// The same into an array of the right length.
void vertex_normals(const TriMesh& mesh, const Adjacency& adjacency, NormalWeight weight,
                    std::span<glm::vec3> normals);

}  // namespace scree::meshing
