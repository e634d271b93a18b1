#pragma once

#include "terrain/fluid/fluid.h"

#include <string>

namespace scree::terrain {

/// The particles as a binary PLY file of points: x y z, vx vy vz, id, and 1 in `touching` for those
/// on the mesh.
std::string particles_as_ply(const FluidState& state);

}  // namespace scree::terrain
