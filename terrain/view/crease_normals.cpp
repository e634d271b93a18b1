#include "terrain/view/crease_normals.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

// Triangles round every vertex, as one list with a begin for each.
struct Ring {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> triangles;

    explicit Ring(const meshing::TriMesh& mesh)
        : begin(mesh.positions.size() + 1, 0U), triangles(mesh.triangles.size() * 3U) {
        for (const glm::uvec3& t : mesh.triangles)
            for (int i = 0; i < 3; ++i)
                ++begin[t[i] + 1U];
        for (std::size_t v = 1; v < begin.size(); ++v)
            begin[v] += begin[v - 1];
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i)
                triangles[next[mesh.triangles[t][i]]++] = static_cast<std::uint32_t>(t);
    }
};

}  // namespace

std::vector<ShadedCorner> shaded_corners(const meshing::TriMesh& mesh, double crease_deg) {
    check_mesh(mesh);
    std::vector<ShadedCorner> corners;
    corners.reserve(mesh.triangles.size() * 3U);
    if (!mesh.normals.empty()) {
        for (const glm::uvec3& t : mesh.triangles)
            for (int i = 0; i < 3; ++i)
                corners.push_back({mesh.positions[t[i]], mesh.normals[t[i]]});
        return corners;
    }
    std::vector<glm::vec3> areas;  // normals as long as twice the area
    areas.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        areas.push_back(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                   mesh.positions[t[2]] - mesh.positions[t[0]]));
    const Ring ring(mesh);
    const auto least = static_cast<float>(std::cos(glm::radians(crease_deg)));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t v = mesh.triangles[t][i];
            glm::vec3 sum(0.0F);
            for (std::uint32_t k = ring.begin[v]; k < ring.begin[v + 1U]; ++k) {
                const glm::vec3& other = areas[ring.triangles[k]];
                if (glm::dot(other, areas[t]) >= least * glm::length(other) * glm::length(areas[t]))
                    sum += other;
            }
            const float length = glm::length(sum);
            corners.push_back(
                {mesh.positions[v], length > 0.0F ? sum / length : glm::vec3(0.0F, 1.0F, 0.0F)});
        }
    return corners;
}

}  // namespace scree::terrain
