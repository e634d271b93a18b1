#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace scree::meshing {

using TrianglePoints = std::array<glm::vec3, 3>;

/// The segment from p to q and the triangle have a point in common; touching counts. Exact.
/// A triangle without area meets nothing.
bool segment_meets_triangle(const glm::vec3& p, const glm::vec3& q, const TrianglePoints& t);

/// Two triangles have a point in common; touching counts. Exact, coplanar ones too. A triangle
/// without area meets nothing.
bool triangles_meet(const TrianglePoints& a, const TrianglePoints& b);

/// Two triangles that share corner 0 have another point in common.
bool triangles_at_a_vertex_meet(const TrianglePoints& a, const TrianglePoints& b);

/// Two triangles that share corners 0 and 1 lie folded onto each other in one plane.
bool triangles_at_an_edge_fold(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace scree::meshing
