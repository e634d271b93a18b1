#include "tests/support/shared_data.h"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/image_io.h"
#include "vision/refine/refine_outlines.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

class RefinePhotos : public testing::TestWithParam<const char*> {};  // a folder

// For every outline the best IoU with a labelled rock.
std::vector<double> best_ious(const std::vector<Outline>& outlines, const LabelMap& truth) {
    const LabelMap found = paint_labels(outlines, truth.width(), truth.height());
    std::vector<double> area_found(outlines.size() + 1), area_truth(65536);
    std::map<std::pair<int, int>, double> both;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const int f = found.data()[i];
        const int t = truth.data()[i];
        ++area_found[static_cast<std::size_t>(f)];
        ++area_truth[static_cast<std::size_t>(t)];
        if (f != 0 && t != 0)
            ++both[{f, t}];
    }
    std::vector<double> best(outlines.size(), 0.0);
    for (const auto& [pair, area] : both) {
        const auto f = static_cast<std::size_t>(pair.first);
        const double all = area_found[f] + area_truth[static_cast<std::size_t>(pair.second)] - area;
        best[f - 1] = std::max(best[f - 1], area / all);
    }
    return best;
}

// Mean IoU before and after, over the outlines that match a rock both times.
struct Gain {
    double before = 0.0;
    double after = 0.0;
    int n_pairs = 0;
};

Gain gain_of(const std::vector<double>& before, const std::vector<double>& after) {
    Gain gain;
    for (std::size_t i = 0; i < before.size(); ++i)
        if (before[i] > 0.5 && after[i] > 0.5) {
            gain.before += before[i];
            gain.after += after[i];
            ++gain.n_pairs;
        }
    gain.before /= std::max(1, gain.n_pairs);
    gain.after /= std::max(1, gain.n_pairs);
    return gain;
}

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
        const Gain gain = gain_of(best_ious(outlines, truth), best_ious(after, truth));
        std::printf("| %s | %zu | %zu | %d | %.4f | %.4f | %+.4f |\n", pair.photo.stem().c_str(),
                    outlines.size(), refined.report.unchanged, gain.n_pairs, gain.before,
                    gain.after, gain.after - gain.before);
        EXPECT_GT(gain.after, gain.before) << pair.photo;
    }
}
INSTANTIATE_TEST_SUITE_P(Folders, RefinePhotos, testing::Values("gravel", "outcrop", "sand"));

}  // namespace
}  // namespace scree::vision
