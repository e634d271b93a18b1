#pragma once

#include "meshing/mesh/adjacency.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace scree::meshing {

/// What a removal of small faces did.
struct SmallFaceReport {
    std::size_t n_collapsed = 0;  ///< Edges shrunk to a vertex.
    std::size_t n_flipped = 0;    ///< Edges of flat slivers turned.
    std::size_t n_vanished = 0;   ///< Tetrahedra below the size that were dropped.
    std::size_t n_blocked = 0;    ///< Short edges that had to stay.
    bool changed = false;
    std::vector<std::uint32_t> kept_triangles;  ///< Old indices, if anything changed.
    std::vector<std::uint32_t> kept_vertices;   ///< The same of the vertices.
};

/// Collapse edges shorter than `shortest` metres, shortest first, and turn the longest edge of
/// slivers lower than a tenth of that (`mesh-erosion.md` 5).
///
/// An edge is collapsed to its middle, to its end on a rim if only one end is there, and only where
/// the surface stays a manifold with the same handles and pieces and no triangle turns by more
/// than 60 degrees. A tetrahedron whose edges are all short is dropped. Only the surroundings of
/// short edges are looked at, as half-edges (OpenMesh); what remains keeps its order.
/// The adjacency is brought up to date; a vertex that stays keeps its texture coordinates; normals
/// are cleared if anything changed.
/// @param before_change  Called once before the first change, if there is one.
/// @throw InvalidInput  the adjacency is another mesh's.
SmallFaceReport remove_small_faces(TriMesh& mesh, Adjacency& adjacency, double shortest,
                                   const std::function<void()>& before_change = {});

}  // namespace scree::meshing
