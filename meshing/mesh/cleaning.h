#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scree::meshing {

struct CleanOptions {
    bool weld = false;  ///< Make one vertex of those at the same place.
};

template <class Visitor>
void describe(CleanOptions& o, Visitor&& field) {
    field("weld", o.weld, {.help = "make one vertex of those at the same place"});
}

/// What was wrong with a mesh.
struct CleanReport {
    std::size_t n_welded = 0;      ///< Vertices at the place of another.
    std::size_t n_degenerate = 0;  ///< Triangles that named a vertex twice or had no area.
    std::size_t n_duplicate = 0;   ///< Triangles with the vertices of an earlier one.
    std::size_t n_flipped = 0;     ///< Triangles that faced the other way than their neighbours, or
                                   ///< in a closed body inwards.
    std::size_t n_cut_edges = 0;   ///< Edges with more than two triangles, or that nothing orients.
    std::size_t n_split = 0;       ///< Vertices added where fans of triangles met at one.
    std::size_t n_unused = 0;      ///< Vertices that no triangle named.
    std::vector<std::uint32_t> source;  ///< For every vertex the one it was.

    bool found_nothing() const {
        return n_welded + n_degenerate + n_duplicate + n_flipped + n_cut_edges + n_split +
                   n_unused ==
               0;
    }
};

/// The findings as one line, such as "2 duplicate triangles, 1 unused vertex"; empty if none.
std::string clean_text(const CleanReport& report);

/// Make an oriented manifold, perhaps with rims, of any triangles.
///
/// In this order: vertices at one place are joined if asked for; triangles without area and
/// repeated ones go; neighbours are made to agree on the outside, each piece the way most of its
/// triangles face, and a closed mesh so that it encloses a positive volume; the surface is cut
/// along edges with three triangles and more, and where several fans meet at a vertex each gets its
/// own; unused vertices go. What stays keeps its order. Normals are dropped, texture coordinates
/// follow.
/// @throw InvalidInput  check_mesh() refuses the mesh.
CleanReport clean_mesh(TriMesh& mesh, const CleanOptions& options = {});

}  // namespace scree::meshing
