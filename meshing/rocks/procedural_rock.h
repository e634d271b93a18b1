#pragma once

#include "base/options.h"
#include "meshing/rocks/rock_mesh.h"

#include <cstdint>

namespace scree::meshing {

/// Component of the noise that shapes a rock (`rocks-and-deformer.md` part B), from 0 to 1.
enum class WorleyComponent {
    First,   ///< F1: pits at the feature points, ridges between.
    Second,  ///< F2: facets.
    Third,   ///< F3: smaller facets.
    Edges,   ///< F2 - F1: knobs at the feature points, creases between.
};

/// How the noise shapes the generalised ellipsoid.
enum class WorleyForm {
    Radial,  ///< One factor for all three semi-axes: star-shaped whatever the noise.
    Axes,    ///< A component for each semi-axis; the one along y fades towards the poles.
};

inline constexpr std::string_view kWorleyComponentNames[] = {"first", "second", "third", "edges"};
inline constexpr std::string_view kWorleyFormNames[] = {"radial", "axes"};

constexpr std::span<const std::string_view> names_of(WorleyComponent) {
    return kWorleyComponentNames;
}
constexpr std::span<const std::string_view> names_of(WorleyForm) {
    return kWorleyFormNames;
}

struct ProceduralRockOptions {
    double width = 0.1;      ///< Along x before noise, m.
    double height = 0.07;    ///< Along y.
    double depth = 0.085;    ///< Along z.
    double amplitude = 0.6;  ///< Strength of the noise, kappa.
    int points = 24;         ///< Feature points; more make finer lumps.
    WorleyForm form = WorleyForm::Axes;
    WorleyComponent radial = WorleyComponent::Second;  ///< Of the radial form.
    WorleyComponent along_x = WorleyComponent::First;  ///< Of the other form.
    WorleyComponent along_y = WorleyComponent::Third;
    WorleyComponent along_z = WorleyComponent::Second;
    int segments = 64;
    int rings = 0;           ///< 0 links them to the segments: half of them, and one.
    bool texcoords = false;  ///< Azimuth and elevation as coordinates; adds a seam.
    RockBase base = RockBase::Half;
    std::int64_t seed = 1;
};

template <class Visitor>
void describe(ProceduralRockOptions& o, Visitor&& field) {
    field("width", o.width, {.min = 1e-6, .max = 1e6, .unit = "m", .help = "size along x"});
    field("height", o.height, {.min = 1e-6, .max = 1e6, .unit = "m", .help = "size along y"});
    field("depth", o.depth, {.min = 1e-6, .max = 1e6, .unit = "m", .help = "size along z"});
    field("amplitude", o.amplitude, {.min = 0, .max = 0.9, .help = "strength of the noise"});
    field("points", o.points, {.min = 3, .max = 10000, .help = "feature points of the noise"});
    field("form", o.form, {.help = "one factor for all axes or one each"});
    field("radial", o.radial, {.help = "component of the radial form"});
    field("along-x", o.along_x, {.help = "component along x, form axes"});
    field("along-y", o.along_y, {.help = "component along y, form axes"});
    field("along-z", o.along_z, {.help = "component along z, form axes"});
    field("segments", o.segments, {.min = 3, .max = 2048, .help = "segments of a ring"});
    field("rings", o.rings, {.min = 0, .max = 2048, .help = "rings; 0 follows the segments"});
    field("texcoords", o.texcoords, {.help = "texture coordinates round the sphere"});
    field("base", o.base, {.help = "resting plane through the rock or under it"});
    field("seed", o.seed, {.min = 0, .max = 9e15, .help = "other seeds give other rocks"});
}

struct ProceduralRock {
    RockMesh rock;           ///< At the origin, or on the ground there.
    double amplitude = 0.0;  ///< Used; less than asked for if that folded the surface.
    int halvings = 0;        ///< How often it was halved.
};

/// A rock from cellular noise on the generalised ellipsoid (eq. 3.2), the same for the same seed.
///
/// @post  The mesh is closed, of positive volume and star-shaped about its centre; seam and poles
///        are whole. Normals are numeric, over the steps of the grid.
/// @throw InvalidOption  a value is outside the range that describe() gives, or one ring.
ProceduralRock make_procedural_rock(const ProceduralRockOptions& options = {});

}  // namespace scree::meshing
