#pragma once

#include "meshing/mesh/tri_mesh.h"
#include "terrain/grid/cell_window.h"
#include "terrain/grid/heightfield.h"
#include "terrain/material/description_map.h"
#include "terrain/view/material_look.h"

#include <cstddef>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// A rock of a ground. Its place is in the ground's x and z; y counts from the ground below its
/// centre, so that it rises and falls with the ground.
struct RockPlace {
    std::size_t mesh = 0;              ///< Place in GroundRocks::meshes.
    glm::mat4 ground_from_rock{1.0F};  ///< Metres.
};

/// Loose rocks that stand in for the pictures of gravel near the eye.
struct GroundRocks {
    std::vector<meshing::TriMesh> meshes;
    std::vector<RockPlace> places;
};

/// A ground to be drawn: what does not change from frame to frame. What it points at is copied to
/// the device by TerrainView's constructor.
struct TerrainGround {
    const Heightfield* base = nullptr;
    const DescriptionMap* map = nullptr;  ///< Null: the first look everywhere.
    std::vector<MaterialLook> looks;      ///< As `map->materials`; empty: plain colours.
    CellWindow window;                    ///< The part to show; empty shows all of it.
    GroundRocks rocks{};  ///< On its gravel; shown within TerrainViewOptions::near_m.
};

/// A mesh in the picture; the mesh must outlive the call.
struct TerrainObject {
    const meshing::TriMesh* mesh = nullptr;
    glm::mat4 world_from_object{1.0F};
    glm::vec3 colour{0.45F, 0.46F, 0.48F};  ///< sRGB, 0 to 1.
    float roughness = 0.6F;
};

/// A perspective camera in the ground's frame.
struct TerrainCamera {
    glm::vec3 eye{0.0F, 1.0F, 1.0F};  ///< Metres.
    glm::vec3 target{0.0F};           ///< What it looks at, metres.
    double field_of_view_deg = 32.0;  ///< From the picture's top to its bottom.
};

/// A sun and a sky. Azimuth 0 shines from +z, 90 from +x.
struct TerrainLight {
    double azimuth_deg = -55.0;
    double elevation_deg = 38.0;
    double strength = 1.0;  ///< Of the sun.
    double sky = 1.0;       ///< Of the sky's light.
};

/// What changes from frame to frame.
struct TerrainFrame {
    /// New displacements of the cells of `changed`, metres; what was shown elsewhere stays. Null
    /// changes nothing. At first all are zero.
    const FloatRaster* displacement = nullptr;
    CellWindow changed;  ///< In cells of the base; empty: the ground's window.
    std::vector<TerrainObject> objects;
    TerrainCamera camera;
    TerrainLight light;
};

/// A camera that has a ground in full view, with a little air around it.
/// @param azimuth_deg    Where the eye stands about +y: 0 in +z, 90 in +x.
/// @param elevation_deg  Of the eye above the ground, 5 to 90.
/// @param aspect         Width of the picture by its height.
/// @param window         The part of the ground in view; empty: all of it.
TerrainCamera camera_over(const Heightfield& field, double azimuth_deg, double elevation_deg,
                          double aspect = 1.6, const CellWindow& window = {});

}  // namespace scree::terrain
