#pragma once

#include "base/options.h"
#include "meshing/mesh/tri_mesh.h"

#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::terrain {

/// Grounds that water can be tried on.
enum class GroundShape {
    Slope,   ///< A plane that falls along +x.
    Canyon,  ///< A straight bed between upright walls.
    Bend,    ///< A river bed with sloping banks that swings once to each side.
    Block,   ///< A closed cube, standing on y = 0.
};
inline constexpr std::string_view kGroundShapeNames[] = {"slope", "canyon", "bend", "block"};
constexpr std::span<const std::string_view> names_of(GroundShape) {
    return kGroundShapeNames;
}

/// A ground about the origin; its bed runs along x, falling towards +x.
struct GroundOptions {
    GroundShape shape = GroundShape::Canyon;
    double length = 4.0;      ///< Along the bed, metres.
    double width = 3.0;       ///< Of everything, metres.
    double edge = 0.08;       ///< Of the triangles, metres.
    double fall = 0.05;       ///< Of the bed, metres a metre.
    double bed_width = 0.8;   ///< Metres.
    double bed_depth = 0.8;   ///< Below the land beside it, metres.
    double bank_width = 0.3;  ///< Of a bend's sloping bank, metres; canyons are nearly upright.
    double swing = 0.5;       ///< Of a bend, to each side, metres.
};

template <class Visitor>
void describe(GroundOptions& o, Visitor&& field) {
    field("shape", o.shape, {.help = "what kind of ground"});
    field("length", o.length, {.min = 0.01, .max = 1e5, .unit = "m", .help = "along the bed"});
    field("width", o.width, {.min = 0.01, .max = 1e5, .unit = "m", .help = "of everything"});
    field("edge", o.edge, {.min = 1e-4, .max = 1e4, .unit = "m", .help = "of the triangles"});
    field("fall", o.fall, {.min = 0, .max = 2, .help = "of the bed, metres a metre"});
    field("bed-width", o.bed_width, {.min = 1e-3, .max = 1e5, .unit = "m", .help = "of the bed"});
    field("bed-depth", o.bed_depth,
          {.min = 0, .max = 1e5, .unit = "m", .help = "of the bed below the land"});
    field("bank-width", o.bank_width,
          {.min = 0, .max = 1e5, .unit = "m", .help = "of a bend's sloping bank"});
    field("swing", o.swing, {.min = 0, .max = 1e5, .unit = "m", .help = "of a bend"});
}

/// The middle line of the bed at x, metres: y is the bed's height, z its place across. Heights
/// are such that the lowest ground lies at y = 0.
glm::vec3 bed_at(const GroundOptions& options, double x);

/// An even mesh of the ground. Slope, canyon and bend are open sheets; the block is closed.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   bed and banks do not fit the width, or it would have more than two million
///                       triangles.
meshing::TriMesh make_ground(const GroundOptions& options);

}  // namespace scree::terrain
