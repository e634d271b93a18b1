#pragma once

#include "vision/thesis/thesis_options.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// What the outlier filter left of a polygon.
struct FilteredPolygon {
    std::vector<std::uint8_t> kept;  ///< One flag per vertex.
    int n_kept = 0;
    double severity = 0.0;  ///< alpha_T that was accepted.
    bool accepted = false;  ///< At least `least_vertices` are left.
};

/// The severity alpha_T above which the vertex `here` is an outlier (3.8) under the options' rule.
///
/// Both inequalities are linear in the severity, so a vertex is an outlier if and only if the
/// severity exceeds this number. A vertex on the spot of its predecessor has minus infinity.
double critical_severity(glm::dvec2 before, glm::dvec2 here, glm::dvec2 after,
                         const ThesisOptions& options);

/// Peel flagged vertices, a whole pass at once, until a pass finds none, at one severity.
std::vector<std::uint8_t> peeled(std::span<const glm::dvec2> polygon, double severity,
                                 const ThesisOptions& options);

/// Run the schedule of severities 1, 0.99, ... (A.7) over the closed polygon of hits.
///
/// @pre  Vertices in increasing azimuth, no two consecutive ones equal.
FilteredPolygon filter_outliers(std::span<const glm::dvec2> polygon, const ThesisOptions& options);

}  // namespace scree::vision
