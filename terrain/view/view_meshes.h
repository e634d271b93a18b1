#pragma once

#include "terrain/gpu/gl_objects.h"
#include "terrain/view/lattice.h"
#include "terrain/view/terrain_frame.h"

#include <cstdint>
#include <map>

namespace scree::terrain {

/// Corners on the device, drawn as they lie or by an index.
struct DrawnMesh {
    GlVertexArray array;
    GlBuffer corners, indices;
    int n_drawn = 0;  ///< Corners or indices.
};

/// The lattice as patches of six control points.
DrawnMesh upload_lattice(const Lattice& lattice);

/// The four sides of an area, from the rim of the ground to a foot: x, z, 1 above or 0 below, side.
DrawnMesh upload_walls(const GroundArea& area, double step);

/// Meshes of objects, kept on the device as long as every frame shows them.
class ObjectMeshes {
public:
    /// The mesh on the device; uploads it if the last frame did not show it.
    /// @throw InvalidInput  the mesh is broken or missing.
    const DrawnMesh& get(const TerrainObject& object);
    /// Drop what was not asked for since the last call.
    void end_frame();

private:
    struct Kept {
        DrawnMesh mesh;
        bool used = false;
    };
    std::map<std::uint64_t, Kept> kept_;  // by a hash of the mesh
};

}  // namespace scree::terrain
