#pragma once

#include "base/raster.h"
#include "meshing/mesh/tri_mesh.h"
#include "terrain/fluid/fluid.h"
#include "terrain/surface/erosion_scene.h"

#include <vector>

#include <glm/vec3.hpp>

namespace scree::apps {

/// The ground as clay. An open one is shown as the top of a block that reaches down to `base`.
Photo picture_of_ground(const meshing::TriMesh& mesh, float base,
                        const terrain::ErosionOutput& view);

/// The ground with the water on it: the redder, the farther a vertex has moved from `before`
/// (which is empty if its vertices are others); particles are blue.
Photo picture_of_erosion(const meshing::TriMesh& mesh, const std::vector<glm::vec3>& before,
                         float base, const terrain::FluidState& fluid,
                         const terrain::ErosionOutput& view);

}  // namespace scree::apps
