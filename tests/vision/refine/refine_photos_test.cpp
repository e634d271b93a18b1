#include "tests/support/shared_data.h"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"
#include "vision/refine/refine_outlines.h"

#include <iomanip>
#include <iostream>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

class RefinePhotos : public testing::TestWithParam<const char*> {};  // a folder

// Prints the table of docs/refinement.md.
TEST_P(RefinePhotos, RaisesTheIouOfMatchedRocks) {
    SCREE_NEEDS_SHARED_DATA();
    for (const auto& pair : test::labelled_photos(GetParam())) {
        const Photo photo = read_photo(pair.photo).pixels;
        const LabelMap truth = read_labels(pair.labels);
        const EdgeField field = ClassicalEdgeDetector().detect(photo);
        const auto outlines = CandidateOutlineFinder().find(photo, field);
        const auto refined = refine_outlines(photo, field, outlines);
        std::vector<Outline> after;
        for (const Rock& rock : refined.rocks)
            after.push_back(rock.outline);
        const double before_iou =
            score_labels(paint_labels(outlines, photo.width(), photo.height()), truth).iou;
        const double after_iou =
            score_labels(paint_labels(after, photo.width(), photo.height()), truth).iou;
        std::cout << std::fixed << std::setprecision(4) << pair.photo.stem().string() << ": "
                  << outlines.size() << " rocks, " << refined.report.unchanged << " kept, IoU "
                  << before_iou << " -> " << after_iou << '\n';
        EXPECT_GT(after_iou, before_iou) << pair.photo;
    }
}
INSTANTIATE_TEST_SUITE_P(Folders, RefinePhotos, testing::Values("gravel", "outcrop", "sand"));

}  // namespace
}  // namespace scree::vision
