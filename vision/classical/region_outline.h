#pragma once

#include "vision/classical/region_index.h"
#include "vision/outline.h"

namespace scree::vision {

enum class Precision { Full, Draft };

/// Star-shaped outline of one region, of the same area as it in every direction.
///
/// The centre is the area centroid, or the deepest point where the centroid lies outside. Holes of
/// pixels that belong to no region count as part of it.
/// @param region     Number of a node of the hierarchy that `index` was made of.
/// @param smooth_px  Width of the smoothing along the border; large rocks get 0.08 of their radius.
/// @param precision  Draft casts a third of the rays in longer steps: enough to judge a candidate.
Outline region_outline(const RegionIndex& index, const RegionNode& node, int region,
                       double smooth_px, Precision precision = Precision::Full);

/// Degrees between rays so that they stand about a pixel apart on a border of this radius.
int ray_stride(double radius);

/// Degrees between rays that are enough to judge an outline: 40 to 60 rays, fewer if it is small.
int draft_stride(double radius);

}  // namespace scree::vision
