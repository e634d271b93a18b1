#pragma once

#include "meshing/mesh/adjacency.h"

#include <cstdint>

namespace scree::terrain {

/// Move every vertex that is on no rim along its normal, by up to `amplitude` mean edges to either
/// side, so that walls which no water reaches look less flat (`mesh-erosion.md` 7.6).
///
/// The same bytes for any number of threads.
/// @pre   The adjacency is the mesh's own.
/// @throw InvalidInput  the amplitude is negative or no number.
void roughen(meshing::TriMesh& mesh, const meshing::Adjacency& adjacency, double amplitude,
             std::uint64_t seed);

}  // namespace scree::terrain
