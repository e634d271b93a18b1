#pragma once

#include "meshing/mesh/adjacency.h"

#include <vector>

namespace scree::meshing {

/// From a vertex to the mean of its neighbours: the uniform Laplace-Beltrami operator
/// (`mesh-erosion.md` 3); 0 without neighbours.
glm::vec3 umbrella_vector(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex);

/// The same at every vertex. Runs in parallel.
std::vector<glm::vec3> umbrella_vectors(const TriMesh& mesh, const Adjacency& adjacency);

/// A vector as a part along a unit normal and the rest.
struct NormalSplit {
    glm::vec3 normal;
    glm::vec3 tangential;
};
NormalSplit split_at_normal(const glm::vec3& vector, const glm::vec3& normal);

}  // namespace scree::meshing
