#pragma once

#include "base/options.h"
#include "meshing/io/point_io.h"
#include "terrain/prepare/ground_lattice.h"

#include <cstddef>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// Which of the points in a cell stays when a survey is thinned.
enum class ThinKeep {
    Lowest,  ///< What grows and stands on the ground lies above it.
    Middle,  ///< The one of middle height: less moved by noise.
};
inline constexpr std::string_view kThinKeepNames[] = {"lowest", "middle"};
constexpr std::span<const std::string_view> names_of(ThinKeep) {
    return kThinKeepNames;
}

/// How points become ground (`mesh-erosion.md` 12).
struct SurveyOptions {
    bool ground_only = true;  ///< Of a LAS file with points of class 2, these alone.
    double spacing = 0.0;     ///< One point a cell of this size, metres; 0: as the lattice's.
    ThinKeep keep = ThinKeep::Lowest;
    double steepest = 0.0;  ///< A point that stands over a neighbour steeper than this is no
                            ///< ground, degrees; 0 keeps all.
    double longest = 0.0;   ///< Triangles with a longer side are holes, metres; 0 fills all.
};

template <class Visitor>
void describe(SurveyOptions& o, Visitor&& field) {
    field("ground-only", o.ground_only, {.help = "take only the ground of classified points"});
    field("spacing", o.spacing,
          {.min = 0, .max = 1e6, .unit = "m", .help = "thin points to one a cell; 0: as needed"});
    field("keep", o.keep, {.help = "which point of a cell stays"});
    field("steepest", o.steepest,
          {.min = 0, .max = 89, .unit = "deg", .help = "drop what stands steeper; 0 keeps all"});
    field("longest", o.longest,
          {.min = 0, .max = 1e6, .unit = "m", .help = "leave wider gaps open; 0 fills all"});
}

/// What became of the points.
struct SurveyReport {
    std::size_t n_points = 0;   ///< In the cloud.
    std::size_t n_ground = 0;   ///< Of them, of the ground's class if that was asked for.
    std::size_t n_thinned = 0;  ///< Left, one a cell.
    std::size_t n_steep = 0;    ///< Of these, dropped as too steep.
    glm::dvec2 moved{0.0};      ///< x and z of the cloud that became 0.
    double area = 0.0;          ///< Covered by triangles, square metres, seen from above.
};

/// Ground from points: ground class, thinning, slope filter, Delaunay triangulation in the plan,
/// its heights at about `n` evenly spread places that the triangles cover.
///
/// @param points  World places: +Y up, metres. They are moved so that the least x and z are 0.
/// @param classes  Of LAS; empty if there are none.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   fewer than three points are left, all on a line, or a place is no number.
GroundLattice lattice_of_points(std::span<const glm::dvec3> points,
                                std::span<const std::uint8_t> classes, std::size_t n,
                                const SurveyOptions& options, SurveyReport* report = nullptr);

}  // namespace scree::terrain
