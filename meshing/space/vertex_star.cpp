#include "meshing/space/vertex_star.h"

#include "meshing/mesh/wedges.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kMostTriangles = 4096;  // around one vertex: pairs grow with the square

// The triangle's corners turned so that `vertex` comes first.
glm::uvec3 turned_to(const glm::uvec3& t, std::uint32_t vertex) {
    if (t.x == vertex)
        return t;
    return t.y == vertex ? glm::uvec3(t.y, t.z, t.x) : glm::uvec3(t.z, t.x, t.y);
}

bool holds(const glm::uvec3& t, std::uint32_t v) {
    return t.x == v || t.y == v || t.z == v;
}

std::size_t n_shared(const glm::uvec3& a, const glm::uvec3& b) {
    return (holds(b, a.x) ? 1U : 0U) + (holds(b, a.y) ? 1U : 0U) + (holds(b, a.z) ? 1U : 0U);
}

// Two triangles with a vertex in common meet elsewhere than in what they share.
bool neighbours_meet(const TriMesh& mesh, const glm::uvec3& a, const glm::uvec3& b) {
    const std::size_t n = n_shared(a, b);
    if (n == 3)
        return true;  // one lies on the other
    if (n == 1) {
        const std::uint32_t shared = holds(b, a.x) ? a.x : holds(b, a.y) ? a.y : a.z;
        return triangles_at_a_vertex_meet(points_of(mesh, turned_to(a, shared)),
                                          points_of(mesh, turned_to(b, shared)));
    }
    const std::uint32_t alone_a = !holds(b, a.x) ? a.x : !holds(b, a.y) ? a.y : a.z;
    const std::uint32_t alone_b = !holds(a, b.x) ? b.x : !holds(a, b.y) ? b.y : b.z;
    const glm::uvec3 first = turned_to(a, alone_a);
    return triangles_at_an_edge_fold(
        {mesh.positions[first.y], mesh.positions[first.z], mesh.positions[alone_a]},
        {mesh.positions[first.y], mesh.positions[first.z], mesh.positions[alone_b]});
}

}  // namespace

bool star_is_flat(const TriMesh& mesh, const Adjacency& adjacency, std::size_t v) {
    if (adjacency.irregular[v] != 0)
        return false;
    constexpr double kMargin = 1e-9;
    glm::dvec3 normal(0.0);
    for_each_wedge(mesh, adjacency, v, [&](const Wedge& wedge) {
        const double lengths = wedge.aa * wedge.bb;
        if (lengths > 0.0)
            normal += wedge.normal() / lengths;
    });
    const double length = glm::length(normal);
    if (!(length > 0.0))
        return false;
    normal /= length;
    bool in_front = true;
    int n_turns = 0;
    glm::dvec3 start(0.0);
    double side = 0.0;  // of the last edge, seen from the first
    double last_ahead = 0.0;
    for_each_wedge(mesh, adjacency, v, [&](const Wedge& wedge) {
        const double turn = glm::dot(normal, wedge.normal());
        in_front = in_front && turn * turn > kMargin * kMargin * wedge.aa * wedge.bb && turn > 0.0;
        if (start == glm::dvec3(0.0))
            start = wedge.a;
        const double next = glm::dot(normal, glm::cross(start, wedge.b));
        n_turns += side < 0.0 && next >= 0.0 ? 1 : 0;
        side = next;
        last_ahead = glm::dot(start, wedge.b);
    });
    if (!in_front)
        return false;
    if (adjacency.rim[v] == 0)
        return n_turns == 1;  // the last edge is the first again, its side exactly 0
    const double margin = kMargin * glm::dot(start, start);
    return n_turns == 0 && !(last_ahead > 0.0 && std::abs(side) <= margin);
}

bool test_star(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex,
               std::size_t limit, std::vector<TrianglePair>& found) {
    const auto corners = adjacency.corners_of(vertex);
    if (corners.size() > kMostTriangles)
        return false;
    for (std::size_t i = 0; i < corners.size() && found.size() < limit; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const std::uint32_t a = corners[i] / 3;
            const std::uint32_t b = corners[j] / 3;
            if (neighbours_meet(mesh, mesh.triangles[a], mesh.triangles[b]))
                found.push_back({std::min(a, b), std::max(a, b)});
        }
    return true;
}

}  // namespace scree::meshing
