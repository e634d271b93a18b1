#pragma once

#include "base/options.h"
#include "meshing/mesh/tri_mesh.h"
#include "meshing/rocks/rock_mesh.h"

#include <vector>

namespace scree::meshing {

struct LodOptions {
    int levels = 4;          ///< Most levels of a chain, the full mesh among them.
    double ratio = 0.5;      ///< Triangles of a level over those of the one before.
    double max_error = 0.1;  ///< Largest error over the mesh's greatest side.
    int min_triangles = 16;  ///< No level goes under it.
};

template <class Visitor>
void describe(LodOptions& o, Visitor&& field) {
    field("levels", o.levels, {.min = 1, .max = 16, .help = "most levels of detail a rock"});
    field("ratio", o.ratio,
          {.min = 0.05, .max = 0.95, .help = "triangles of a level over those of the last"});
    field("max-error", o.max_error,
          {.min = 0, .max = 1, .help = "largest error over the rock's size"});
    field("min-triangles", o.min_triangles,
          {.min = 4, .max = 1e6, .help = "fewest triangles of a level"});
}

/// One level of detail.
struct LodLevel {
    TriMesh mesh;
    double error = 0.0;  ///< How far the surface moved from the full mesh, metres: what the
                         ///< simplifier's quadrics estimate of each step, added as squares.
};

/// The mesh and ever coarser ones, each simplified from the one before by edge collapses onto
/// vertices that were there, so that normals and texture coordinates stay those of the photograph.
///
/// Level 0 is the mesh itself, in the order that optimise_for_gpu() gives and without triangles
/// that name a place twice. Seams stay closed. The chain ends early where the next level would
/// break a limit or be no solid while the full mesh is one.
///
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   check_mesh() refuses the mesh, or it has no triangle.
std::vector<LodLevel> build_lod_chain(const TriMesh& mesh, const LodOptions& options = {});

/// The chains of many rocks, in their order.
std::vector<std::vector<LodLevel>> build_lod_chains(const std::vector<RockMesh>& rocks,
                                                    const LodOptions& options = {});

}  // namespace scree::meshing
