#include "meshing/curvature/umbrella.h"

#include "base/error.h"
#include "base/parallel.h"

#include <glm/geometric.hpp>

namespace scree::meshing {

glm::vec3 umbrella_vector(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex) {
    const auto ring = adjacency.neighbours_of(vertex);
    if (ring.empty())
        return glm::vec3(0.0F);
    const glm::dvec3 here(mesh.positions[vertex]);
    glm::dvec3 sum(0.0);
    for (const std::uint32_t other : ring)
        sum += glm::dvec3(mesh.positions[other]) - here;
    return glm::vec3(sum / static_cast<double>(ring.size()));
}

std::vector<glm::vec3> umbrella_vectors(const TriMesh& mesh, const Adjacency& adjacency) {
    if (adjacency.n_vertices() != mesh.positions.size())
        fail<InvalidInput>("the mesh has ", mesh.positions.size(), " vertices, its adjacency ",
                           adjacency.n_vertices());
    std::vector<glm::vec3> result(mesh.positions.size());
    parallel_for_each_index(0, result.size(), 2048, [&](std::size_t v) {
        result[v] = umbrella_vector(mesh, adjacency, v);
    });
    return result;
}

NormalSplit split_at_normal(const glm::vec3& vector, const glm::vec3& normal) {
    const glm::vec3 along = glm::dot(vector, normal) * normal;
    return {along, vector - along};
}

}  // namespace scree::meshing
