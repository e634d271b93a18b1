#include "meshing/mesh/normals.h"

#include "base/error.h"
#include "base/parallel.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kGrain = 2048;

glm::dvec3 contribution(const glm::dvec3& a, const glm::dvec3& b, NormalWeight weight) {
    const glm::dvec3 normal = glm::cross(a, b);
    if (weight == NormalWeight::Area)
        return normal;
    if (weight == NormalWeight::Angle) {
        const double length = glm::length(normal);
        return length > 0.0 ? normal * (std::atan2(length, glm::dot(a, b)) / length)
                            : glm::dvec3(0.0);
    }
    const double squares = glm::dot(a, a) * glm::dot(b, b);
    return squares > 0.0 ? normal / squares : glm::dvec3(0.0);
}

glm::vec3 unit(const glm::dvec3& sum) {
    const double square = glm::dot(sum, sum);
    return square > 0.0 && std::isfinite(square) ? glm::vec3(sum / std::sqrt(square))
                                                 : glm::vec3(0.0F);
}

}  // namespace

void vertex_normals(const TriMesh& mesh, const Adjacency& adjacency, NormalWeight weight,
                    std::span<glm::vec3> normals) {
    if (adjacency.n_vertices() != mesh.positions.size() || normals.size() != mesh.positions.size())
        fail<InvalidInput>("the mesh has ", mesh.positions.size(), " vertices, its adjacency ",
                           adjacency.n_vertices(), " and the normals ", normals.size());
    parallel_for_each_index(0, normals.size(), kGrain, [&](std::size_t v) {
        const glm::dvec3 here(mesh.positions[v]);
        glm::dvec3 sum(0.0);
        for (const std::uint32_t c : adjacency.corners_of(v)) {
            const glm::uvec3 t = vertices_from(mesh, c);
            sum += contribution(glm::dvec3(mesh.positions[t.y]) - here,
                                glm::dvec3(mesh.positions[t.z]) - here, weight);
        }
        normals[v] = unit(sum);
    });
}

std::vector<glm::vec3> vertex_normals(const TriMesh& mesh, const Adjacency& adjacency,
                                      NormalWeight weight) {
    std::vector<glm::vec3> normals(mesh.positions.size());
    vertex_normals(mesh, adjacency, weight, normals);
    return normals;
}

}  // namespace scree::meshing
