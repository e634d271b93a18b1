#pragma once

#include "base/raster.h"
#include "vision/thesis/thesis_options.h"

#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// Ends of lines: on-pixels with exactly one on-neighbour of eight, row by row.
std::vector<glm::ivec2> line_ends(const Mask& lines);

/// Join the ends of thin lines to what lies ahead of them (`rocks-and-deformer.md` A.4.4).
///
/// Every end is joined by a straight line to the nearest other end, else to the nearest edge pixel,
/// within `link_reach` and `link_angle` of its branch's direction. Ends are taken row by row.
Mask linked(const Mask& lines, const ThesisOptions& options);

/// Delete 8-connected pieces of fewer than `least_pixels` pixels.
Mask without_small_pieces(const Mask& lines, int least_pixels);

/// Thin, link and delete small pieces: I_T to I_E.
Mask link_edges(const Mask& thresholded, const ThesisOptions& options);

}  // namespace scree::vision
