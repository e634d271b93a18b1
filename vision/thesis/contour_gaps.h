#pragma once

#include "vision/thesis/thesis_options.h"

#include <array>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// The retained vertices on either side of a gap, in increasing azimuth about the centre.
struct ContourGap {
    glm::dvec2 before_last{0.0};  ///< Survivor before `last`.
    glm::dvec2 last{0.0};         ///< The vertex just before the gap.
    glm::dvec2 first{0.0};        ///< The vertex just after it.
    glm::dvec2 after_first{0.0};  ///< Survivor after `first`.
};

/// Handles and ends of the cubic that leaves `last` and arrives at `first` along the polygon's
/// tangents there; handles are a third of the chord (AMB-09).
std::array<glm::dvec2, 4> gap_curve(const ContourGap& gap);

/// Angle of the gap as seen from the centre, radians in [0, 2 pi).
double gap_angle(const ContourGap& gap, glm::dvec2 centre);

/// The points that fill a gap: `bezier_points` of the curve at t = m / (bezier_points + 1).
///
/// GuardedBezier: if the azimuth about the centre does not strictly increase along them, radii are
/// interpolated between the ends instead; radii stay within 0.5 to 1.5 of the interpolated ones.
/// Chord: none.
std::vector<glm::dvec2> gap_points(const ContourGap& gap, glm::dvec2 centre,
                                   const ThesisOptions& options);

}  // namespace scree::vision
