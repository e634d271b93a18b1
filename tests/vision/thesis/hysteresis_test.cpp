#include "vision/thesis/hysteresis.h"

#include "base/error.h"
#include "tests/vision/thesis/masks.h"
#include "vision/thesis/thesis_edge_detector.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

FloatRaster ramp(int n) {
    FloatRaster values(n, 1);
    for (int i = 0; i < n; ++i)
        values(i, 0) = static_cast<float>(i) / static_cast<float>(n);
    return values;
}

TEST(Thresholds, FollowEveryRuleAndTheLowOneIsAThird) {
    ThesisOptions options;
    for (const auto& [rule, high] : {std::pair(ThresholdRule::BrightShare, 0.75),
                                     std::pair(ThresholdRule::FirstQuartile, 0.25),
                                     std::pair(ThresholdRule::ThirdQuartileNonzero, 0.75),
                                     std::pair(ThresholdRule::Fixed, options.fixed_threshold)}) {
        options.threshold = rule;
        const Thresholds t = choose_thresholds(ramp(1000), options);
        EXPECT_NEAR(t.high, high, 0.002);
        EXPECT_DOUBLE_EQ(t.low, t.high / 3.0);
    }
}

TEST(Thresholds, NonzeroRuleIgnoresUnchangedPixels) {
    FloatRaster values(1000, 1);
    for (int i = 0; i < 100; ++i)
        values(i, 0) = 0.2F + 0.001F * static_cast<float>(i);
    ThesisOptions options;
    options.threshold = ThresholdRule::ThirdQuartileNonzero;
    EXPECT_NEAR(choose_thresholds(values, options).high, 0.274, 0.002);
    EXPECT_THROW(choose_thresholds(FloatRaster{}, options), InvalidInput);
}

TEST(Hysteresis, WeakPixelsNeedAStrongOne) {
    FloatRaster values(12, 3);
    for (const int x : {1, 2, 3, 7, 8, 9})
        values(x, 1) = 0.2F;
    values(3, 1) = 0.5F;
    values(4, 0) = 0.2F;  // diagonal neighbour of the strong one
    values(9, 1) = 0.3F;  // equal to the upper threshold: not strong
    const Mask edges = hysteresis(values, {.high = 0.3F, .low = 0.1});
    for (int x = 0; x < 12; ++x)
        EXPECT_EQ(edges(x, 1), x >= 1 && x <= 3 ? 1 : 0) << x;
    EXPECT_EQ(edges(4, 0), 1);
}

// The reference picture of RK-06, a step of one row: the dark side lights up two pixels deep.
TEST(Hysteresis, ReferencePictureOfAStep) {
    Photo photo(24, 24, glm::u8vec3(200));
    for (int y = 12; y < 24; ++y)
        for (int x = 0; x < 24; ++x)
            photo(x, y) = glm::u8vec3(100);
    const EdgeStages stages = detect_thesis_edges(photo, {});
    for (int y = 0; y < 24; ++y)
        EXPECT_EQ(stages.thresholded(11, y), y == 12 || y == 13 ? 1 : 0) << y;
}

TEST(Hysteresis, LiteralFirstQuartileMarksMostOfTheInterior) {
    const auto made = test::make_synthetic_photo(test::suited_picture(1));
    ThesisOptions literal;
    literal.threshold = ThresholdRule::FirstQuartile;
    literal.least_threshold = 0.0;
    const auto wrong =
        test::mask_quality(detect_thesis_edges(made.photo, literal).thresholded, made.labels);
    const auto sound =
        test::mask_quality(detect_thesis_edges(made.photo, {}).thresholded, made.labels);
    EXPECT_GT(wrong.interior, 0.5);
    EXPECT_LT(sound.interior, 0.1);
}

}  // namespace
}  // namespace scree::vision
