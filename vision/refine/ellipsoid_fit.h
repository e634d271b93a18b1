#pragma once

#include "vision/refine/edge_hits.h"
#include "vision/refine/refine_outlines.h"
#include "vision/refine/shape.h"

#include <vector>

namespace scree::vision {

struct EllipsoidFit {
    Shape shape;
    double uncertainty = 0.0;  ///< Root mean square standard deviation of the radius, px.
    int iterations = 0;
    bool usable = false;  ///< The solver ended on finite numbers.
};

/// Least squares over centre and radius function; `shape` is where it starts.
/// @param window  The search window that gave the hits, px.
EllipsoidFit fit_ellipsoid(const EdgeMaps& maps, const std::vector<EdgeHit>& hits,
                           const Shape& shape, double window, const RefineOptions& options);

}  // namespace scree::vision
