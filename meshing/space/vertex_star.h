#pragma once

// Behind SelfIntersectionFinder alone; not installed.

#include "meshing/mesh/adjacency.h"
#include "meshing/space/self_intersection.h"
#include "meshing/space/triangle_pair.h"

#include <cstddef>
#include <vector>

namespace scree::meshing {

inline TrianglePoints points_of(const TriMesh& mesh, const glm::uvec3& t) {
    return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

/// A proof that the triangles around a vertex do not meet each other: seen along a direction in
/// front of all of them, they go once around (or, at a rim, less than once). Margins are far above
/// rounding; where they are not kept nothing is proved.
bool star_is_flat(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex);

/// Test every pair of triangles around a vertex, until `found` holds `limit` pairs. False if there
/// are so many triangles that nothing was tested.
bool test_star(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex,
               std::size_t limit, std::vector<TrianglePair>& found);

}  // namespace scree::meshing
