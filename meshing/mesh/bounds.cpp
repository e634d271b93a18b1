#include "meshing/mesh/bounds.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

double squared_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a;
    const double length = squared(edge);
    const double t = length > 0.0 ? std::clamp(-glm::dot(a, edge) / length, 0.0, 1.0) : 0.0;
    return squared(a + t * edge);
}

// Squared distance from the origin, or anything not under `bound` if it is not under `bound`.
double squared_to_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           double bound) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = squared(normal);
    const double height = glm::dot(normal, a);
    if (area > 0.0) {
        const double to_plane = height * height / area;
        if (to_plane >= bound)
            return to_plane;  // the plane is no farther than the triangle
        const bool inside = glm::dot(glm::cross(a, b), normal) >= 0.0 &&
                            glm::dot(glm::cross(b, c), normal) >= 0.0 &&
                            glm::dot(glm::cross(c, a), normal) >= 0.0;
        if (inside)
            return to_plane;
    }
    return std::min({squared_to_segment(a, b), squared_to_segment(b, c), squared_to_segment(c, a)});
}

}  // namespace

Box bounding_box(const TriMesh& mesh) {
    if (mesh.positions.empty())
        fail<InvalidInput>("a mesh without vertices has no bounding box");
    Box box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& p : mesh.positions) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    return box;
}

float outer_radius(const TriMesh& mesh) {
    double farthest = 0.0;
    for (const glm::vec3& p : mesh.positions)
        farthest = std::max(farthest, squared(glm::dvec3(p)));
    return farthest == 0.0 ? 0.0F
                           : std::nextafter(static_cast<float>(std::sqrt(farthest)),
                                            std::numeric_limits<float>::infinity());
}

float inner_radius(const TriMesh& mesh) {
    double nearest = kInfinity;
    for (const glm::uvec3& t : mesh.triangles)
        nearest = std::min(nearest, squared_to_triangle(glm::dvec3(mesh.positions[t.x]),
                                                        glm::dvec3(mesh.positions[t.y]),
                                                        glm::dvec3(mesh.positions[t.z]), nearest));
    return nearest == kInfinity || nearest == 0.0
               ? 0.0F
               : std::nextafter(static_cast<float>(std::sqrt(nearest)), 0.0F);
}

}  // namespace scree::meshing
