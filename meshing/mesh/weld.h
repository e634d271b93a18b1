#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace scree::meshing {

/// For every vertex the number of its place: vertices with equal coordinates share one. Places
/// are numbered in the order in which they first occur.
std::vector<std::uint32_t> weld_map(const TriMesh& mesh);

/// The mesh with one vertex a place and without normals, texture coordinates and triangles that
/// name a place twice.
TriMesh weld(const TriMesh& mesh);

}  // namespace scree::meshing
