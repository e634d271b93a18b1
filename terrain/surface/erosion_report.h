#pragma once

#include <cstddef>

namespace scree::terrain {

/// Seconds of all steps together: the source's five columns, and what it left out.
struct ErosionTimes {
    double iteration = 0.0;  ///< All that follows, and the fluid.
    double affected = 0.0;
    double curvature = 0.0;
    double laplacian = 0.0;
    double displacement = 0.0;
    double fluid = 0.0;   ///< Frames, and taking the moved mesh.
    double upkeep = 0.0;  ///< Weathering, small faces, looks for self-intersections.
};

/// What the last step saw and did.
struct ErosionStep {
    double mean_edge = 0.0;  ///< Metres; of wear alone, as the curvatures and the farthest way.
    double least_curvature = 0.0;
    double greatest_curvature = 0.0;
    double farthest = 0.0;       ///< Longest way of a vertex, metres.
    std::size_t n_affected = 0;  ///< Vertices.
    std::size_t n_particles = 0;
    std::size_t n_touching = 0;  ///< Of them.
};

/// What a run did.
struct ErosionReport {
    int steps = 0;                         ///< Done and kept.
    int restarts = 0;                      ///< Times that a tangle was rolled back.
    double step_limit = 0.0;               ///< At the end.
    bool finished = false;                 ///< Not stopped by tangles.
    std::size_t intersections_before = 0;  ///< Pairs of triangles that cross.
    std::size_t intersections = 0;         ///< At the end.
    double volume_before = 0.0;  ///< By signed_volume(), cubic metres; of an open mesh a measure.
    double volume = 0.0;
    double mean_particles = 0.0;
    double mean_touching = 0.0;
    double mean_affected = 0.0;   ///< Vertices a step.
    std::size_t n_collapsed = 0;  ///< Edges, by small-face removal.
    ErosionStep last;             ///< Not kept in checkpoints.
    ErosionTimes times;
};

}  // namespace scree::terrain
