#pragma once

#include "base/raster.h"
#include "meshing/mesh/tri_mesh.h"

#include <span>
#include <vector>

namespace scree::apps {

/// A mesh as clay, or in the colours of its scaled curvature if there are as many values as
/// vertices.
struct WornMesh {
    meshing::TriMesh mesh;
    std::vector<float> scaled_curvature;
};

/// Both from the same eye, the first on the left.
Photo before_and_after(const WornMesh& before, const WornMesh& after);

/// The mesh from eight sides, beside each other.
Photo turntable_of(const WornMesh& worn);

}  // namespace scree::apps
