#pragma once

#include "base/options.h"
#include "base/progress.h"
#include "vision/edge_field.h"
#include "vision/rock_data.h"

#include <cstddef>
#include <vector>

namespace scree::vision {

struct RefineOptions {
    double window = 0.3;        ///< Reach of the search for edges, share of the mean radius...
    double least_window = 2.0;  ///< ...but at least this, pixels...
    double most_window = 10.0;  ///< ...and at most this, pixels.
    double hit_error = 1.2;     ///< Standard deviation of a clear edge hit, pixels.
    double attraction = 2.0;    ///< Pull of the edge field, relative to that of the hits.
    double roughness = 1.0;     ///< Deviation from an ellipse that is expected, 1 for rocks.
    int passes = 2;             ///< Searches for edges, each with half the window of the last.
};

template <class Visitor>
void describe(RefineOptions& o, Visitor&& field) {
    field("window", o.window, {.min = 0.01, .max = 1, .help = "edge search, share of the radius"});
    field("least-window", o.least_window, {.min = 0.5, .max = 100, .unit = "px"});
    field("most-window", o.most_window, {.min = 0.5, .max = 100, .unit = "px"});
    field("hit-error", o.hit_error, {.min = 0.05, .max = 20, .unit = "px"});
    field("attraction", o.attraction, {.min = 0, .max = 100});
    field("roughness", o.roughness, {.min = 0.01, .max = 100});
    field("passes", o.passes, {.min = 1, .max = 5});
}

struct RefineReport {
    std::size_t refined = 0;     ///< Outlines that the fit replaced.
    std::size_t unchanged = 0;   ///< Outlines kept because the fit left its window or lost support.
    std::size_t iterations = 0;  ///< Solver steps of all rocks together.
};

struct RefinedRocks {
    std::vector<Rock> rocks;  ///< One per outline, in the same order.
    RefineReport report;
};

/// Fit a generalised ellipsoid to every outline: its centre and the logarithm of its radius as a
/// truncated Fourier series in the azimuth, whose order grows with the rock's size.
///
/// The fit weighs sub-pixel edge hits along rays about the outline (with a robust loss), the edge
/// field under the outline, the outline it started from and the roughness rocks have. A rock's
/// uncertainty is the root mean square, over the azimuth, of the radius's standard deviation from
/// the covariance of the fit. An outline whose fit leaves the search window or stands on less edge
/// than before is kept as it was. The depth is the least radius (`rocks-and-deformer.md` A.11,
/// AMB-10); confidence and touches_border are passed on. Same result for any number of threads.
///
/// @pre   The boundary channel is filled and has the photograph's size.
/// @post  Radii are positive and finite; rocks that touch the border end there.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   a channel's size differs from the photograph's, the boundary is empty, or
///                       an outline has a centre or radius that is no positive number.
/// @throw Cancelled      the listener asked for a stop.
RefinedRocks refine_outlines(const Photo& photo, const EdgeField& field,
                             std::vector<Outline> outlines, const RefineOptions& options = {},
                             const Progress* progress = nullptr);

}  // namespace scree::vision
