#include "vision/thesis/parameter_search.h"

#include "base/error.h"
#include "testdata/synthetic_photo.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

std::vector<LabelledPicture> pictures(int n) {
    std::vector<LabelledPicture> result;
    for (int i = 0; i < n; ++i) {
        test::SyntheticOptions o;
        o.width = 130;
        o.height = 100;
        o.n_rocks = 25;
        o.median_diameter = 24;
        o.greatest_diameter = 45;
        o.texture = 0.3;
        o.seed = static_cast<std::uint64_t>(100 + i);
        const auto made = test::make_synthetic_photo(o);
        result.push_back({made.photo, made.labels});
    }
    return result;
}

TEST(ParameterSearch, BeatsTheDefaultsOnPicturesItDidNotSee) {
    ThesisOptions start;
    start.working_width = 0;
    const SearchOptions few{.sweeps = 1, .most_evaluations = 14};
    const auto labelled = pictures(4);
    const SearchReport report = search_parameters(labelled, start, few);
    EXPECT_GT(report.best_train_score, report.start_train_score);
    EXPECT_GT(report.best_test_score, report.start_test_score + 0.05);
    EXPECT_EQ(report.n_evaluations, 14);
}

TEST(ParameterSearch, SameSeedGivesTheSameAnswer) {
    const SearchOptions few{.sweeps = 1, .most_evaluations = 4, .seed = 3};
    const auto labelled = pictures(2);
    ThesisOptions start;
    start.working_width = 0;
    const SearchReport first = search_parameters(labelled, start, few);
    const SearchReport second = search_parameters(labelled, start, few);
    EXPECT_EQ(first.best_test_score, second.best_test_score);
    EXPECT_EQ(first.best.bright_share, second.best.bright_share);
}

TEST(ParameterSearch, NeedsTwoPictures) {
    EXPECT_THAT([] { search_parameters(pictures(1)); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("1 pictures")));
}

}  // namespace
}  // namespace scree::vision
