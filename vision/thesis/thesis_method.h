#pragma once

#include "base/progress.h"
#include "vision/rock_data.h"
#include "vision/thesis/slice_finder.h"
#include "vision/thesis/thesis_edge_detector.h"
#include "vision/thesis/thesis_options.h"

#include <string>
#include <utility>
#include <vector>

namespace scree::vision {

/// The rocks that the source's method finds and what finding them took.
struct ThesisResult {
    std::vector<Rock> rocks;  ///< In the photograph's pixels, ordered by falling confidence.
    std::size_t n_samples = 0;
    std::size_t n_traced = 0;
    double edge_seconds = 0.0;   ///< Scaling and mask.
    double slice_seconds = 0.0;  ///< Rays, filter, centres, gaps, radii.
};

/// The whole method on one photograph: scaled once to the working width, edges, slices, back.
///
/// Finds what ThesisEdgeDetector and RayOutlineFinder find together, without carrying the mask to
/// the photograph's size and back in between.
/// @throw InvalidOption  an option is out of its range.
/// @throw InvalidInput   the photograph is empty.
/// @throw Cancelled      the listener asked for a stop.
ThesisResult find_thesis_rocks(const Photo& photo, const ThesisOptions& options = {},
                               Progress* progress = nullptr);

/// A picture of every stage, by name, in the order of the chain, at working size: grey, median,
/// accumulation, thresholded, linked, samples, contours.
std::vector<std::pair<std::string, Photo>> thesis_stages(const Photo& photo,
                                                         const ThesisOptions& options = {});

}  // namespace scree::vision
