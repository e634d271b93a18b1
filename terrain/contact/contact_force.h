#pragma once

#include "base/options.h"
#include "terrain/contact/underside.h"
#include "terrain/grid/load.h"

#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// Which way an object's weight pushes the soil below it aside.
enum class Outward {
    Radial,   ///< Away from the vertical through the object's centre (C.9).
    Surface,  ///< Up the slope of the underside, so that every lug of a tread pushes soil into its
              ///< groove; radial where the underside is level. Nearly the same on a sphere.
};
inline constexpr std::string_view kOutwardNames[] = {"radial", "surface"};
constexpr std::span<const std::string_view> names_of(Outward) {
    return kOutwardNames;
}

/// How an object's force becomes forces on cells (`rocks-and-deformer.md` C.9, F.4).
struct ContactOptions {
    Reading reading = Reading::Sound;  ///< Literal: the rule of F.4, F = p * mobility * force.
    Outward outward = Outward::Surface;
    double spread = 0.5;        ///< kappa: share of the vertical load that pushes outwards.
    double gravity = 9.81;      ///< m/s^2
    double unit_stress = 10e3;  ///< Pa over one cell that makes a force of 1 in grid units.
    /// Most force on a cell, grid units: soil yields instead of bearing more, and the rest pushes
    /// nothing. 0 sets no limit, as C.9 does: then a cell that reaches far into an object takes
    /// nearly all of its force, and thin columns of soil shoot up beside it.
    double yield = 0.0;
};

template <class Visitor>
void describe(ContactOptions& o, Visitor&& field) {
    field("reading", o.reading, {.help = "share the force by depth, or the published rule"});
    field("outward", o.outward, {.help = "which way a weight pushes soil aside"});
    field("spread", o.spread,
          {.min = 0, .max = 10, .help = "share of the vertical load that pushes outwards"});
    field("gravity", o.gravity, {.min = 0, .max = 100, .unit = "m/s2", .help = "of free fall"});
    field("unit-stress", o.unit_stress,
          {.min = 1e-6, .max = 1e9, .unit = "Pa", .help = "of a force of one grid unit"});
    field("yield", o.yield, {.min = 0, .max = 1e9, .help = "most force on a cell; 0 is no limit"});
}

/// An object that may touch the ground.
struct PressingBody {
    const Underside* underside = nullptr;  ///< Borrowed.
    glm::dvec3 force{0.0};                 ///< Beside its weight, newtons; +y is up.
    double mass = 0.0;                     ///< Kilograms.
    glm::dvec2 centre{0.0};                ///< Where it stands: x and z, metres.
};

/// What one object does to the ground in one step.
struct BodyContact {
    int cells = 0;                   ///< That it reaches into.
    double area_m2 = 0.0;            ///< Of those cells.
    double deepest_m = 0.0;          ///< Greatest penetration.
    double overlap_m3 = 0.0;         ///< Volume of ground it stands in.
    glm::dvec2 drag_force{0.0};      ///< Sum of the shares of the horizontal force, newtons.
    double outward_force = 0.0;      ///< Sum of the lengths of the outward shares, newtons.
    double unspent_force = 0.0;      ///< Sum of what passed the yield, newtons.
    bool smaller_than_cell = false;  ///< Over the ground, but over no cell's centre: no track.
};

/// Loads of a group of objects on one window, and what each contributed.
struct ContactLoad {
    Load load;
    std::vector<BodyContact> bodies;
};

/// Ground under a window: heights in metres, mobility for the literal rule alone.
struct GroundUnder {
    CellWindow window;
    const FloatRaster* heights = nullptr;   ///< Base and displacement.
    const FloatRaster* mobility = nullptr;  ///< May be null for the sound form.
    double cell_size = 1.0;
};

/// Smallest window that holds those of all bodies; empty if all are.
CellWindow common_window(std::span<const PressingBody> bodies);

/// Spread the bodies' forces over the cells where they reach into the ground, and add them up.
///
/// Sound: the share of a cell is its penetration over the sum of penetrations, so the shares of an
/// object sum to its force; nothing pushes where nothing penetrates. Literal: every cell whose
/// underside is not above the ground takes penetration (metres) times mobility times the horizontal
/// force, not divided by any sum; weight has no effect.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   a raster is missing or of another size than its window, a force, mass or
///                       centre is not finite, or a mass is negative.
ContactLoad contact_load(std::span<const PressingBody> bodies, const GroundUnder& ground,
                         const ContactOptions& options = {});

}  // namespace scree::terrain
