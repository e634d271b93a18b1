#include "meshing/mesh/tri_mesh.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

bool all_finite(const std::vector<glm::vec3>& values) {
    return std::all_of(values.begin(), values.end(), [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    });
}

bool empty_or_complete(std::size_t n, std::size_t n_vertices) {
    return n == 0 || n == n_vertices;
}

}  // namespace

void check_mesh(const TriMesh& mesh) {
    const std::size_t n = mesh.positions.size();
    if (!empty_or_complete(mesh.normals.size(), n) || !empty_or_complete(mesh.texcoords.size(), n))
        fail<InvalidInput>("the mesh has ", n, " vertices but ", mesh.normals.size(),
                           " normals and ", mesh.texcoords.size(), " texture coordinates");
    if (!all_finite(mesh.positions) || !all_finite(mesh.normals))
        fail<InvalidInput>("the mesh has a position or normal that is no number");
    for (const glm::uvec3& t : mesh.triangles)
        if (t.x >= n || t.y >= n || t.z >= n)
            fail<InvalidInput>("a triangle names vertex ", std::max({t.x, t.y, t.z}),
                               ", the mesh has ", n);
}

double signed_volume(const TriMesh& mesh) {
    double six_fold = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        const glm::dvec3 b(mesh.positions[t.y]);
        const glm::dvec3 c(mesh.positions[t.z]);
        six_fold += glm::dot(a, glm::cross(b, c));
    }
    return six_fold / 6.0;
}

double surface_area(const TriMesh& mesh) {
    double twice = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        const glm::dvec3 b(mesh.positions[t.y]);
        const glm::dvec3 c(mesh.positions[t.z]);
        twice += glm::length(glm::cross(b - a, c - a));
    }
    return 0.5 * twice;
}

}  // namespace scree::meshing
