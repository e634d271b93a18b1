#pragma once

#include "terrain/contact/contact_force.h"
#include "terrain/contact/object_motion.h"
#include "terrain/contact/shapes.h"
#include "terrain/grid/deformer.h"
#include "terrain/material/description_map.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

inline constexpr int kMaxGroundSide = 16384;  ///< Cells; more is refused before memory is taken.

/// A form that is added to the ground's heights. Places and lengths in metres, x and z.
struct GroundShape {
    enum class Kind {
        Hills,    ///< Fractal noise.
        Ripples,  ///< Waves with bent crests.
        Pile,     ///< A cone.
        Dune,     ///< A crescent: gentle to the wind, steep to the lee.
        Ramp,     ///< A tilted plane through its centre.
        Mound,    ///< A Gaussian.
    };
    Kind kind = Kind::Hills;
    glm::dvec2 centre_m{0.0};
    double height_m = 0.1;       ///< Of the top; of hills and ripples, from trough to crest.
    double length_m = 1.0;       ///< Wavelength, or width at the foot.
    double slope_deg = 30.0;     ///< Of a pile's flank, a dune's lee side or a ramp.
    double direction_deg = 0.0;  ///< Where a dune's lee side faces, a ramp rises, waves run.
    int octaves = 4;             ///< Of hills.
    std::uint64_t seed = 0;
};

/// The ground before anything moves.
struct GroundSpec {
    int width = 512, height = 512;  ///< Cells along x and z.
    double cell_size_m = 0.005;
    std::filesystem::path heights;  ///< Picture of heights in metres; else flat at 0.
    double height_scale = 1.0;      ///< Times the picture's values.
    std::vector<GroundShape> shapes;
};

/// Ground that is painted with a material; later regions cover earlier ones.
struct MaterialRegion {
    int material = 0;                 ///< Id.
    std::vector<glm::dvec2> polygon;  ///< Corners, metres; empty: a disc.
    glm::dvec2 centre_m{0.0};
    double radius_m = 0.0;
    double ragged_m = 0.0;  ///< How far the border wanders, so that it does not look cut.
};

/// A mesh from a GLB file.
struct MeshFile {
    std::filesystem::path file;
};
using ObjectShape = std::variant<SphereShape, BoxShape, TyreShape, BootShape, MeshFile>;

/// One thing that moves over the ground.
struct SceneObject {
    std::string name;
    ObjectShape shape;
    ObjectMotion motion;
    double mass_kg = 10.0;
    glm::dvec3 force_n{0.0};  ///< Beside its weight.
    double drag_n = 0.0;      ///< Along its way over the ground, while it moves.
    glm::dvec3 colour{0.25, 0.26, 0.28};
};

/// Where the pictures are taken from.
struct SceneCamera {
    double azimuth_deg = 25.0, elevation_deg = 35.0, field_of_view_deg = 32.0;
    std::optional<glm::dvec3> eye_m, target_m;  ///< Both or none; none sees the whole ground.
    double light_azimuth_deg = -55.0, light_elevation_deg = 32.0;
};

/// Rocks that lie on the ground and are drawn as meshes where they are near the eye; they ride on
/// it, and nothing moves them aside.
struct SceneRocks {
    std::filesystem::path file;  ///< GLB; empty: none.
    double near_m = 0.0;         ///< As TerrainViewOptions::near_m.
};

/// What a run writes beside the height maps.
struct SceneOutputs {
    int picture_width = 640, picture_height = 400;  ///< px
    int every = 1;                                  ///< Frames from one picture to the next.
    int preview_width = 360;                        ///< px, of the animated preview.
    int mesh_side = 320;                            ///< Most vertices along a side of terrain.glb.
    int texture_side = 1024;                        ///< Of its colour picture, px.
};

/// Everything a run needs (docs/scene-files.md).
struct Scene {
    std::string source;  ///< Name in messages.
    GroundSpec ground;
    std::vector<Material> materials;        ///< In order of id; empty with a map file.
    std::filesystem::path map;              ///< A description map's materials.json, or empty.
    std::vector<MaterialRegion> regions;    ///< Over the first material.
    std::map<std::string, double> bearing;  ///< Stiffness by material name, kPa a metre of depth.
    std::vector<SceneObject> objects;
    DeformerOptions deformer;
    ContactOptions contact{.yield = 1.0};
    int frames = 100;
    double frame_rate = 25.0;
    int substeps = 0;     ///< Solver steps in a frame; 0: as many as the fastest object needs.
    bool settle = false;  ///< Bring the ground to rest when the last frame is over.
    std::uint64_t seed = 1;
    SceneCamera camera;
    SceneRocks rocks;
    SceneOutputs outputs;
    /// Files that the scene names and the JSON path of each, for messages.
    std::vector<std::pair<std::filesystem::path, std::string>> files;
};

inline constexpr double kDefaultBearing = 300.0;  ///< kPa a metre: loose sand.

}  // namespace scree::terrain
