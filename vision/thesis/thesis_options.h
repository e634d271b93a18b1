#pragma once

#include "base/options.h"
#include "vision/thesis/readings.h"

namespace scree::vision {

/// Every parameter of the source's method (`rocks-and-deformer.md` A.20). The defaults are the
/// sound reading; lengths are pixels of the working picture.
struct ThesisOptions {
    int working_width = 900;  ///< Width that pictures are scaled to; 0 leaves them.
    // Edges
    int median_kernel = 5;  ///< Odd.
    ChangeMode change = ChangeMode::Any;
    int offset = 2;    ///< Epsilon of (3.6).
    int levels = 256;  ///< L.
    ThresholdRule threshold = ThresholdRule::BrightShare;
    double bright_share = 0.25;     ///< Share of pixels above the upper threshold.
    double fixed_threshold = 0.15;  ///< Upper threshold of ThresholdRule::Fixed.
    double low_share = 1.0 / 3.0;   ///< Lower threshold over upper.
    double least_threshold = 0.03;  ///< The upper one never falls below; keeps noise out.
    int link_reach = 5;             ///< Longest gap that linking closes.
    double link_angle = 45.0;       ///< Most a link may turn from its branch, degrees.
    int link_passes = 1;
    int least_component = 8;  ///< Shorter pieces of edge are deleted, pixels.
    // Slices
    int grid_spacing = 5;
    VisitOrder order = VisitOrder::RowMajor;
    int rays = 90;         ///< H, while the centre settles.
    int final_rays = 360;  ///< In the last pass.
    TurnRule turn_rule = TurnRule::SignedOutward;
    double cosine_factor = 0.65;  ///< a of (3.8).
    double sine_factor = 0.5;     ///< b of (3.8).
    SeveritySchedule schedule = SeveritySchedule::Restart;
    double severity_step = 0.01;
    int least_vertices = 10;
    CentroidKind centroid = CentroidKind::Area;
    double centroid_tolerance = 0.5;
    int centroid_iterations = 20;
    GapFill gap_fill = GapFill::GuardedBezier;
    int bezier_points = 5;
    double greatest_gap = 180.0;  ///< A wider gap rejects the slice, degrees; 360 keeps all.
    DepthFrom depth_from = DepthFrom::FinalRadii;
    double inset = 0.0;  ///< Moves contours inwards, from the middle of the gap to the rock.
    // Quality filters (ours)
    double least_area = 30.0;           ///< Square pixels.
    double greatest_radius = 0.4;       ///< Share of the picture's width.
    double greatest_overlap = 0.3;      ///< Share of a slice that lies on earlier ones.
    double least_retained_share = 0.3;  ///< Share of vertices that are hits.
};

template <class Visitor>
void describe(ThesisOptions& o, Visitor&& field) {
    constexpr FieldInfo kShare{.min = 0, .max = 1};
    field("working-width", o.working_width, {.min = 0, .max = 8192, .unit = "px"});
    field("median-kernel", o.median_kernel, {.min = 1, .max = 15, .unit = "px", .help = "odd"});
    field("change", o.change, {.help = "how the four comparisons combine"});
    field("offset", o.offset, {.min = 1, .max = 32, .unit = "px"});
    field("levels", o.levels, {.min = 1, .max = 4096});
    field("threshold", o.threshold, {.help = "rule of the upper threshold"});
    field("bright-share", o.bright_share, kShare);
    field("fixed-threshold", o.fixed_threshold, kShare);
    field("low-share", o.low_share, kShare);
    field("least-threshold", o.least_threshold, kShare);
    field("link-reach", o.link_reach, {.min = 0, .max = 64, .unit = "px"});
    field("link-angle", o.link_angle, {.min = 0, .max = 180, .unit = "deg"});
    field("link-passes", o.link_passes, {.min = 0, .max = 10});
    field("least-component", o.least_component, {.min = 0, .max = 1e6, .unit = "px"});
    field("grid-spacing", o.grid_spacing, {.min = 1, .max = 1000, .unit = "px"});
    field("order", o.order, {.help = "in which samples are visited"});
    field("rays", o.rays, {.min = 8, .max = 3600});
    field("final-rays", o.final_rays, {.min = 8, .max = 3600});
    field("turn-rule", o.turn_rule, {.help = "reading of the outlier test"});
    field("cosine-factor", o.cosine_factor, kShare);
    field("sine-factor", o.sine_factor, kShare);
    field("schedule", o.schedule, {.help = "how the severity is lowered"});
    field("severity-step", o.severity_step, {.min = 0.001, .max = 1});
    field("least-vertices", o.least_vertices, {.min = 3, .max = 1000});
    field("centroid", o.centroid, {.help = "of the area or of the vertices"});
    field("centroid-tolerance", o.centroid_tolerance, {.min = 1e-6, .max = 100, .unit = "px"});
    field("centroid-iterations", o.centroid_iterations, {.min = 1, .max = 1000});
    field("gap-fill", o.gap_fill, {.help = "what closes a gap"});
    field("bezier-points", o.bezier_points, {.min = 0, .max = 100});
    field("greatest-gap", o.greatest_gap, {.min = 1, .max = 360, .unit = "deg"});
    field("depth-from", o.depth_from, {.help = "radii that the depth is the least of"});
    field("inset", o.inset, {.min = 0, .max = 50, .unit = "px"});
    field("least-area", o.least_area, {.min = 0, .max = 1e9, .unit = "px2"});
    field("greatest-radius", o.greatest_radius, {.min = 0, .max = 1e6});
    field("greatest-overlap", o.greatest_overlap, kShare);
    field("least-retained-share", o.least_retained_share, kShare);
}

/// The defaults of a reading: Sound is `ThesisOptions{}`; Literal takes every ambiguous passage as
/// it is printed (AMB-01 to AMB-10) and turns the quality filters off.
ThesisOptions thesis_options(Reading reading);

/// check() and what ranges cannot say.
/// @throw InvalidOption  a value is out of its range or the median kernel is even.
void check_thesis(const ThesisOptions& options);

}  // namespace scree::vision
