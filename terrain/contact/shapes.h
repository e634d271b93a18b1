#pragma once

#include "base/options.h"
#include "meshing/mesh/tri_mesh.h"

#include <glm/vec3.hpp>

namespace scree::terrain {

/// A ball about the origin. Poles lie on the y axis.
struct SphereShape {
    double radius_m = 0.5;
    int rings = 48;  ///< From pole to pole; twice as many segments around.
};

/// A block about the origin.
struct BoxShape {
    glm::dvec3 size_m{1.0};
};

/// A tyre on its hub, axis along z, about the origin: rows of lugs that lean like a chevron, with
/// grooves across the tread and a smooth crown between them.
struct TyreShape {
    double radius_m = 0.33;
    double width_m = 0.22;
    double tread_depth_m = 0.015;  ///< Of the grooves; 0 is a slick.
    int lugs = 22;                 ///< Around, in each of the two rows.
    int segments = 352;            ///< Around.
};

/// A boot that stands on y = 0 with its toe towards +x, the middle of its sole over the origin:
/// heel and forefoot with lugs, an arch between them.
struct BootShape {
    double length_m = 0.30;
    double width_m = 0.11;
    double lug_depth_m = 0.012;
    double height_m = 0.12;  ///< At the ankle.
    int lugs = 9;            ///< Rows along the sole.
    int segments = 160;      ///< Along the sole; the quality of the lugs' edges.
    bool left = false;       ///< Mirrored.
};

template <class Visitor>
void describe(SphereShape& o, Visitor&& field) {
    field("radius_m", o.radius_m, {.min = 1e-4, .max = 1e3, .unit = "m", .help = "radius"});
    field("rings", o.rings, {.min = 3, .max = 1024, .help = "rings from pole to pole"});
}

template <class Visitor>
void describe(TyreShape& o, Visitor&& field) {
    field("radius_m", o.radius_m, {.min = 1e-3, .max = 100, .unit = "m", .help = "outer radius"});
    field("width_m", o.width_m, {.min = 1e-3, .max = 100, .unit = "m", .help = "of the tread"});
    field("tread_depth_m", o.tread_depth_m,
          {.min = 0, .max = 10, .unit = "m", .help = "depth of the grooves"});
    field("lugs", o.lugs, {.min = 1, .max = 200, .help = "around, in each row"});
    field("segments", o.segments, {.min = 8, .max = 4096, .help = "around"});
}

template <class Visitor>
void describe(BootShape& o, Visitor&& field) {
    field("length_m", o.length_m, {.min = 1e-3, .max = 100, .unit = "m", .help = "heel to toe"});
    field("width_m", o.width_m, {.min = 1e-3, .max = 100, .unit = "m", .help = "at the ball"});
    field("lug_depth_m", o.lug_depth_m,
          {.min = 0, .max = 10, .unit = "m", .help = "depth between the lugs"});
    field("height_m", o.height_m, {.min = 1e-3, .max = 100, .unit = "m", .help = "at the ankle"});
    field("lugs", o.lugs, {.min = 1, .max = 60, .help = "rows along the sole"});
    field("segments", o.segments, {.min = 16, .max = 2048, .help = "along the sole"});
    field("left", o.left, {.help = "the left boot"});
}

/// Closed meshes of positive volume, facing outwards.
/// @throw InvalidOption  a value is out of range, or the tread is deeper than half the radius
/// (tyre)
///                       or than half the height (boot).
meshing::TriMesh sphere_mesh(const SphereShape& shape);
meshing::TriMesh box_mesh(const BoxShape& shape);
meshing::TriMesh tyre_mesh(const TyreShape& shape);
meshing::TriMesh boot_mesh(const BootShape& shape);

}  // namespace scree::terrain
