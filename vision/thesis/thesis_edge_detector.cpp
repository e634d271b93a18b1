#include "vision/thesis/thesis_edge_detector.h"

#include "base/error.h"
#include "vision/thesis/edge_linking.h"
#include "vision/thesis/level_slicing.h"
#include "vision/thesis/working_size.h"

#include <algorithm>

namespace scree::vision {

EdgeStages detect_thesis_edges(const Photo& photo, const ThesisOptions& options) {
    check_thesis(options);
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels, at least one is needed");
    EdgeStages stages;
    stages.grey = grey_of(photo);
    stages.median = median_filtered(stages.grey, options.median_kernel);
    stages.accumulation = accumulate_changes(stages.median, options);
    stages.thresholds = choose_thresholds(stages.accumulation, options);
    stages.thresholded = hysteresis(stages.accumulation, stages.thresholds);
    stages.linked = link_edges(stages.thresholded, options);
    return stages;
}

ThesisEdgeDetector::ThesisEdgeDetector(const ThesisOptions& options) : options_(options) {
    check_thesis(options);
}

EdgeField ThesisEdgeDetector::detect(const Photo& photo, Progress* progress) const {
    report_progress(progress, "finding edges", 0.0);
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels, at least one is needed");
    const glm::ivec2 size{photo.width(), photo.height()};
    const Photo working = scaled_photo(photo, working_size(size, options_.working_width));
    const Mask mask = scaled_mask(detect_thesis_edges(working, options_).linked, size);
    EdgeField field;
    field.boundary = FloatRaster(size.x, size.y);
    std::transform(mask.begin(), mask.end(), field.boundary.begin(),
                   [](std::uint8_t on) { return on != 0 ? 1.0F : 0.0F; });
    return field;
}

}  // namespace scree::vision
