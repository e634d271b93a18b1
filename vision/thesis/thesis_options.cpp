#include "vision/thesis/thesis_options.h"

namespace scree::vision {

ThesisOptions thesis_options(Reading reading) {
    ThesisOptions o;
    if (reading == Reading::Sound)
        return o;
    o.change = ChangeMode::All;
    o.threshold = ThresholdRule::FirstQuartile;
    o.least_threshold = 0.0;
    o.final_rays = o.rays;
    o.turn_rule = TurnRule::UnsignedAnd;
    o.schedule = SeveritySchedule::Cumulative;
    o.centroid = CentroidKind::Mean;
    o.gap_fill = GapFill::PlainBezier;
    o.greatest_gap = 360.0;
    o.depth_from = DepthFrom::Hits;
    o.least_area = 0.0;
    o.greatest_radius = 1e6;
    o.greatest_overlap = 1.0;
    o.least_retained_share = 0.0;
    return o;
}

void check_thesis(const ThesisOptions& options) {
    check(options);
    if (options.median_kernel % 2 == 0)
        fail<InvalidOption>("median-kernel is ", options.median_kernel,
                            ", must be odd: 1, 3, 5, 7 and so on");
}

}  // namespace scree::vision
