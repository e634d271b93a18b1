#pragma once

#include "base/options.h"
#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree::meshing {

struct DecimationOptions {
    std::int64_t vertices = 10000;  ///< To be left.
    double evenness = 0.01;  ///< 0: all the detail where the shape bends; 1: everywhere alike.
    bool keep_up = false;    ///< No triangle that looks up may come to stand upright or look down.
};

template <class Visitor>
void describe(DecimationOptions& o, Visitor&& field) {
    field("vertices", o.vertices, {.min = 4, .max = 1e8, .help = "vertices of the mesh"});
    field(
        "evenness", o.evenness,
        {.min = 0, .max = 1, .help = "0: detail goes where the shape bends; 1: everywhere alike"});
    field("keep-up", o.keep_up, {.help = "keep what looks up looking up"});
}

struct DecimationReport {
    std::size_t n_collapsed = 0;
    bool reached = false;                      ///< No more vertices than asked for.
    std::vector<std::uint32_t> kept_vertices;  ///< Old indices, increasing.
};

/// Collapse edges, cheapest first, until so many vertices are left (Garland and Heckbert 1997).
///
/// An edge is collapsed onto one of its ends, so every vertex that stays keeps its bits. What a
/// collapse costs is the squared distance to the planes of all triangles that met at both ends, to
/// upright planes along rims, and `evenness` of that to their places. The surface stays a manifold
/// with the same handles, pieces and rims; no triangle turns by more than 60 degrees at once or
/// becomes a sliver. Normals are dropped, texture coordinates stay with their vertices.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   check_mesh() refuses the mesh, or it is no oriented manifold: clean_mesh()
///                       makes it one.
DecimationReport decimate(TriMesh& mesh, const DecimationOptions& options);

}  // namespace scree::meshing
