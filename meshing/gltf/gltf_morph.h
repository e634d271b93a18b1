#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scree::meshing {

/// A mesh at an earlier time.
struct MorphShape {
    std::string name;
    std::vector<glm::vec3> positions;  ///< As many as the mesh has.
};

/// A mesh that changes its shape but not its triangles.
struct MorphScene {
    std::string name;
    TriMesh mesh;                    ///< As it is at the end; texture coordinates are left out.
    std::vector<MorphShape> shapes;  ///< Earlier ones, first to last; at least one.
    double seconds = 4.0;            ///< From the first shape to the mesh.
};

/// The scene as binary glTF 2.0: the last mesh, a morph target for each earlier shape, and an
/// animation of their weights that plays from the first shape to the last.
///
/// Viewers that know no morph targets show the end. Normals of all shapes are those of their
/// triangles, weighted by area.
/// @throw InvalidInput  the mesh breaks check_mesh() or has no triangle, there is no shape, a shape
///        has another number of vertices or a number that is not finite, `seconds` is not positive,
///        or the file would pass 2 GiB.
std::vector<std::uint8_t> encode_morph_glb(const MorphScene& scene);

}  // namespace scree::meshing
