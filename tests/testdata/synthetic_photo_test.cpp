#include "testdata/synthetic_photo.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

namespace scree::test {
namespace {

SyntheticOptions small(std::uint64_t seed) {
    return {.width = 300, .height = 220, .n_rocks = 80, .greatest_diameter = 70, .seed = seed};
}

class Synthetic : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Synthetic, SameSeedGivesSameBytesOnAnyThreadCount) {
    const SyntheticPhoto first = make_synthetic_photo(small(GetParam()));
    const ThreadLimit one(1);
    const SyntheticPhoto second = make_synthetic_photo(small(GetParam()));
    EXPECT_EQ(first.photo, second.photo);
    EXPECT_EQ(first.labels, second.labels);
    EXPECT_NE(first.photo, make_synthetic_photo(small(GetParam() + 1)).photo);
}

TEST_P(Synthetic, LabelsAreThePaintedOutlinesAndNoneOverlap) {
    const SyntheticPhoto made = make_synthetic_photo(small(GetParam()));
    ASSERT_GT(made.outlines.size(), 25U);
    ASSERT_LE(made.outlines.size(), 80U);
    EXPECT_EQ(made.labels, vision::paint_labels(made.outlines, 300, 220));
    auto reversed = made.outlines;
    std::reverse(reversed.begin(), reversed.end());
    auto labels = vision::paint_labels(reversed, 300, 220);
    const auto n = static_cast<std::uint16_t>(reversed.size() + 1);
    for (auto& label : labels)
        label = label == 0 ? label : static_cast<std::uint16_t>(n - label);
    EXPECT_EQ(labels, made.labels) << "painting order matters, so two rocks overlap";
    const std::set<std::uint16_t> seen(made.labels.begin(), made.labels.end());
    EXPECT_EQ(seen.size(), made.outlines.size() + 1);
}

TEST_P(Synthetic, RocksKeepTheirGapAndSizes) {
    SyntheticOptions options = small(GetParam());
    options.gap = 5;
    const SyntheticPhoto made = make_synthetic_photo(options);
    const LabelMap& l = made.labels;
    for (int y = 0; y < l.height(); ++y)
        for (int x = 0; x + 3 < l.width(); ++x)
            ASSERT_FALSE(l(x, y) != 0 && l(x + 3, y) != 0 && l(x, y) != l(x + 3, y));
    for (const auto& outline : made.outlines) {
        EXPECT_GT(vision::equivalent_diameter(outline), 0.9 * options.least_diameter);
        EXPECT_LT(vision::equivalent_diameter(outline), 1.4 * options.greatest_diameter);
        EXPECT_EQ(outline.confidence, 1.0F);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Synthetic, testing::Range<std::uint64_t>(1, 5));

TEST(SyntheticPhoto, WholeRocksStayInside) {
    SyntheticOptions options = small(3);
    options.whole_rocks = true;
    const auto made = make_synthetic_photo(options);
    ASSERT_GT(made.outlines.size(), 15U);
    for (const auto& outline : made.outlines)
        EXPECT_FALSE(outline.touches_border);
}

double mean_over(const SyntheticPhoto& made, bool rocks) {
    double sum = 0.0;
    double n = 0.0;
    for (std::size_t i = 0; i < made.photo.size(); ++i)
        if ((made.labels.data()[i] != 0) == rocks) {
            sum += made.photo.data()[i].g;
            n += 1.0;
        }
    return sum / n;
}

TEST(SyntheticPhoto, GapsAreDarkUnlessFilledWithSand) {
    SyntheticOptions options = small(2);
    const auto gravel = make_synthetic_photo(options);
    EXPECT_GT(mean_over(gravel, true), mean_over(gravel, false) + 40);
    options.matrix = 1.0;
    const auto sand = make_synthetic_photo(options);
    EXPECT_GT(mean_over(sand, false), mean_over(gravel, false) + 40);
    EXPECT_EQ(sand.labels, gravel.labels) << "looks must not move rocks";
}

TEST(SyntheticPhoto, CellsLeaveOnlyCrevices) {
    SyntheticOptions options = small(5);
    options.layout = Layout::Cells;
    options.gap = 4;
    const auto made = make_synthetic_photo(options);
    EXPECT_GT(made.outlines.size(), 25U);
    const auto covered = std::count_if(made.labels.begin(), made.labels.end(),
                                       [](std::uint16_t label) { return label != 0; });
    EXPECT_GT(static_cast<double>(covered), 0.65 * static_cast<double>(made.labels.size()));
    for (int y = 0; y < 220; ++y)
        for (int x = 0; x + 2 < 300; ++x)
            ASSERT_FALSE(made.labels(x, y) != 0 && made.labels(x + 2, y) != 0 &&
                         made.labels(x, y) != made.labels(x + 2, y));
}

TEST(SyntheticPhoto, NoRocksGiveBareGround) {
    const auto bare = make_synthetic_photo({.width = 40, .height = 30, .n_rocks = 0});
    EXPECT_TRUE(bare.outlines.empty());
    EXPECT_EQ(bare.photo.width(), 40);
}

TEST(SyntheticPhoto, ErrorsNameTheOption) {
    EXPECT_THAT([] { make_synthetic_photo({.width = 0}); },
                testing::ThrowsMessage<InvalidOption>(testing::HasSubstr("width is 0")));
    EXPECT_THAT([] { make_synthetic_photo({.median_diameter = 300}); },
                testing::ThrowsMessage<InvalidOption>(testing::HasSubstr("median-diameter")));
}

}  // namespace
}  // namespace scree::test
