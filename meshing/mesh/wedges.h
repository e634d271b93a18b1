#pragma once

#include "meshing/mesh/adjacency.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace scree::meshing {

/// A triangle as one of its vertices sees it: the edges to the other two, counter-clockwise.
struct Wedge {
    glm::dvec3 a;   ///< To the next vertex.
    glm::dvec3 b;   ///< To the one after it.
    double aa, bb;  ///< Squared lengths.
    std::uint32_t corner;

    double ab() const { return glm::dot(a, b); }
    glm::dvec3 normal() const { return glm::cross(a, b); }  ///< Of twice the area.
};

/// Call `body(wedge)` for every triangle around a vertex. In a simple fan every neighbour is
/// fetched and measured once.
template <class Body>
inline void for_each_wedge(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex,
                           Body&& body) {
    const glm::dvec3 here(mesh.positions[vertex]);
    const auto corners = adjacency.corners_of(vertex);
    const auto edge_to = [&](std::uint32_t other) {
        return glm::dvec3(mesh.positions[other]) - here;
    };
    Wedge wedge{};
    if (corners.empty())
        return;
    if (adjacency.irregular[vertex] != 0) {
        for (const std::uint32_t corner : corners) {
            const glm::uvec3 t = vertices_from(mesh, corner);
            wedge = {edge_to(t.y), edge_to(t.z), 0, 0, corner};
            wedge.aa = glm::dot(wedge.a, wedge.a);
            wedge.bb = glm::dot(wedge.b, wedge.b);
            body(wedge);
        }
        return;
    }
    const auto ring = adjacency.neighbours_of(vertex);
    wedge.a = edge_to(ring[0]);
    wedge.aa = glm::dot(wedge.a, wedge.a);
    for (std::size_t j = 0; j < corners.size(); ++j) {
        wedge.b = edge_to(ring[j + 1 < ring.size() ? j + 1 : 0]);
        wedge.bb = glm::dot(wedge.b, wedge.b);
        wedge.corner = corners[j];
        body(static_cast<const Wedge&>(wedge));
        wedge.a = wedge.b;
        wedge.aa = wedge.bb;
    }
}

/// The part of a triangle's area nearest to the wedge's own corner; a quarter or a half of it
/// where the triangle is obtuse (Meyer et al. 2003).
inline double corner_area(const Wedge& wedge, double twice_area) {
    const double ab = wedge.ab();
    const double at_a = wedge.aa - ab;  // dot products at the two other corners
    const double at_b = wedge.bb - ab;
    if (ab < 0.0)
        return 0.25 * twice_area;
    if (at_a < 0.0 || at_b < 0.0)
        return 0.125 * twice_area;
    return (wedge.bb * at_a + wedge.aa * at_b) / (8.0 * twice_area);
}

}  // namespace scree::meshing
