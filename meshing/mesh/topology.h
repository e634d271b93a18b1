#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <string>

namespace scree::meshing {

/// What a mesh is as a surface, after vertices at the same place are taken as one.
///
/// Pieces, boundaries and genus are counted only where `oriented` holds: no half-edge structure
/// holds the other meshes.
struct TopologyReport {
    std::size_t n_vertices = 0;    ///< Distinct places that a triangle uses.
    std::size_t n_edges = 0;       ///< Distinct pairs of places that a triangle joins.
    std::size_t n_triangles = 0;   ///< Triangles with three distinct places.
    std::size_t n_collapsed = 0;   ///< Triangles with fewer; left out of all else.
    std::size_t n_thin = 0;        ///< Triangles with three distinct places but no area.
    std::size_t n_pieces = 0;      ///< Connected components.
    std::size_t n_boundaries = 0;  ///< Rims: closed loops of edges with one triangle.
    int genus = 0;                 ///< Handles of all pieces together; closed manifolds only.
    bool closed = false;           ///< There are triangles and every edge has two.
    bool manifold = false;         ///< Oriented, and no vertex joins two fans of triangles.
    bool oriented = false;         ///< No edge has three triangles, and two agree on the outside.
};

/// Look at a mesh through a half-edge structure.
/// @throw InvalidInput  check_mesh() refuses the mesh.
TopologyReport analyse_topology(const TriMesh& mesh);

/// What keeps the mesh from being a closed, oriented manifold of positive volume without triangles
/// of no area, as one sentence; empty if nothing does.
/// @throw InvalidInput  check_mesh() refuses the mesh.
std::string solid_defect(const TriMesh& mesh);

}  // namespace scree::meshing
