#pragma once

#include "meshing/mesh/tri_mesh.h"

namespace scree::meshing {

/// Order triangles for the vertex cache and vertices by first use, and drop vertices that no
/// triangle names. The surface stays as it is.
/// @throw InvalidInput  check_mesh() refuses the mesh.
void optimise_for_gpu(TriMesh& mesh);

}  // namespace scree::meshing
