#include "tests/support/shared_data.h"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// Floors a little under what the built-in tables reach on the photographs they were made from;
// docs/vision-classical.md has the figures for photographs left out of the training.
struct Floor {
    const char* folder;
    double ap50;        ///< Mean.
    double least_ap50;  ///< Worst picture.
    double iou;         ///< Mean.
};

class SharedPhotos : public testing::TestWithParam<Floor> {};

TEST_P(SharedPhotos, StayAboveTheFloor) {
    SCREE_NEEDS_SHARED_DATA();
    std::vector<LabelScore> scores;
    for (const auto& pair : test::labelled_photos(GetParam().folder)) {
        const Photo photo = read_photo(pair.photo).pixels;
        const auto rocks =
            CandidateOutlineFinder().find(photo, ClassicalEdgeDetector().detect(photo));
        scores.push_back(score_labels(paint_labels(rocks, photo.width(), photo.height()),
                                      read_labels(pair.labels)));
        EXPECT_GE(scores.back().ap50, GetParam().least_ap50) << pair.photo;
    }
    ASSERT_FALSE(scores.empty());
    const LabelScore mean = mean_score(scores);
    EXPECT_GE(mean.ap50, GetParam().ap50);
    EXPECT_GE(mean.iou, GetParam().iou);
}
INSTANTIATE_TEST_SUITE_P(Folders, SharedPhotos,
                         testing::Values(Floor{"gravel", 0.64, 0.53, 0.83},
                                         Floor{"outcrop", 0.37, 0.26, 0.77},
                                         Floor{"sand", 0.69, 0.66, 0.84}),
                         [](const auto& p) { return std::string(p.param.folder); });

}  // namespace
}  // namespace scree::vision
