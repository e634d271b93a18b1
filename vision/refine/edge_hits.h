#pragma once

#include "base/raster.h"
#include "vision/outline.h"

#include <vector>

namespace scree::vision {

/// What the rays look at; both have the photograph's size.
struct EdgeMaps {
    FloatRaster boundary;  ///< Smoothed boundary channel.
    FloatRaster inside;    ///< Smoothed inside channel; may be empty.
};

/// One ray from an outline's centre and the edge it met.
struct EdgeHit {
    glm::dvec2 direction{0.0};
    glm::dvec2 point{0.0};   ///< Where the edge was met, px.
    double start = 0.0;      ///< The outline's own radius along the ray, px.
    double obliquity = 1.0;  ///< Cosine between the ray and the outline's normal.
    double weight = 0.0;     ///< 0: nothing found, 1: a clear edge.
    bool beyond = false;     ///< The outline leaves the picture here: nothing can be seen.
};

/// Bilinear value at a point in pixels; the nearest pixel's beyond the raster.
double sample(const FloatRaster& raster, glm::dvec2 point);

/// Cast `n_rays` evenly spread rays from the outline's centre. Along each the clearest sub-pixel
/// edge within `window` pixels of the outline is taken; nearer ones are preferred.
std::vector<EdgeHit> edge_hits(const EdgeMaps& maps, const Outline& outline, int n_rays,
                               double window);

/// Mean of the boundary map under the rays' ends at the given outline, where it is in the picture.
double edge_support(const EdgeMaps& maps, const Outline& outline, int n_rays);

}  // namespace scree::vision
