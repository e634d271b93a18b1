#pragma once

#include "base/progress.h"
#include "meshing/rocks/rock_mesh.h"

#include <vector>

namespace scree::terrain {

/// Round rocks as a river does: weather every mesh, then scale it about its centre to its old
/// volume, so that it still fills its outline.
///
/// A step moves a vertex at most a hundredth of the rock's mean radius (and a tenth of its mean
/// edge), so coarse and fine meshes are rounded alike. Boxes, radii and normals are brought up to
/// date; texture coordinates stay with their vertices. Runs in parallel, the same bytes for any
/// number of threads.
/// @param steps  0 leaves the rocks as they are.
/// @throw InvalidOption  steps is negative; InvalidInput  a mesh that weather() refuses; Cancelled.
void round_rocks(std::vector<meshing::RockMesh>& rocks, int steps,
                 const Progress* progress = nullptr);

}  // namespace scree::terrain
