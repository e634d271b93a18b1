#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec2.hpp>

namespace scree::meshing {

/// The Delaunay triangulation of points in a plane: no triangle's circle holds another point.
struct PlanTriangulation {
    std::vector<glm::uvec3> triangles;  ///< Indices of points, counter-clockwise (x right, y up).
    std::size_t n_repeated = 0;         ///< Points at the place of another, left out.
};

/// Triangulate points, by insertion with flips (Lawson) in rounds along a space-filling curve.
///
/// Places are rounded to a grid of 2^22 cells along the longer side of their box; on it every
/// decision is exact (128-bit integers), so no order or cluster of points can break the result.
/// Along the hull triangles may be missing whose height is below 1/256 of their length.
/// @throw InvalidInput  more than 2^28 points, or one that is not finite.
PlanTriangulation triangulate_plan(std::span<const glm::dvec2> points);

}  // namespace scree::meshing
