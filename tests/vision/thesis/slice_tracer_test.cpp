#include "vision/thesis/slice_tracer.h"

#include "base/random.h"
#include "tests/vision/thesis/masks.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(CentroidIteration, ConvergesFromOffCentreStarts) {
    Mask mask(200, 200);
    test::draw_circle(mask, {100.5, 98.5}, 50);
    for (const auto kind : {CentroidKind::Area, CentroidKind::Mean}) {
        ThesisOptions options;
        options.centroid = kind;
        const SliceTracer tracer(mask, options);
        for (int degrees = 0; degrees < 360; degrees += 30) {
            const double a = degrees * std::numbers::pi / 180;
            const glm::dvec2 start =
                glm::dvec2(100.5, 98.5) + 30.0 * glm::dvec2(std::cos(a), std::sin(a));
            const auto centre = tracer.settle(start);
            ASSERT_TRUE(centre);
            EXPECT_LE(glm::distance(centre->point, glm::dvec2(100.5, 98.5)), 1.0);
            EXPECT_LE(centre->n_iterations, 20);
        }
    }
}

TEST(CentroidIteration, AbandonsAnOpenField) {
    const SliceTracer tracer(Mask(100, 100), {});
    EXPECT_FALSE(tracer.settle({50, 50}));
    EXPECT_FALSE(tracer.trace({50, 50}));
}

TEST(SliceTracer, DrawnEllipseGivesItsRadii) {
    Mask mask(200, 160);
    const auto radius = [](double a) { return 1 / std::hypot(std::cos(a) / 60, std::sin(a) / 40); };
    test::draw_curve(mask, {100.5, 80.5}, radius);
    const auto slice = SliceTracer(mask, {}).trace({80.5, 70.5});
    ASSERT_TRUE(slice);
    EXPECT_NEAR(slice->outline.centre.x, 100.5, 1);
    EXPECT_NEAR(slice->outline.centre.y, 80.5, 1);
    for (int k = 0; k < kRadii; ++k)
        EXPECT_NEAR(slice->outline.radii[static_cast<std::size_t>(k)],
                    radius(k * std::numbers::pi / 180), 1.6);
    EXPECT_FALSE(slice->outline.touches_border);
    EXPECT_GT(slice->retained_share, 0.95);
    EXPECT_EQ(slice->outline.confidence, 1.0F);
}

// A gap of 30 degrees: the escaping rays hit the frame, go as outliers, and the curve closes it.
TEST(SliceTracer, GapIsFilledByTheCurve) {
    Mask mask(240, 200);
    const auto radius = [](double a) { return 1 / std::hypot(std::cos(a) / 60, std::sin(a) / 45); };
    test::draw_curve(mask, {120.5, 100.5}, radius, 20, 50);
    for (int x = 0; x < 240; ++x)
        mask(x, 2) = mask(x, 197) = 1;
    for (int y = 0; y < 200; ++y)
        mask(2, y) = mask(237, y) = 1;
    const auto slice = SliceTracer(mask, {}).trace({110.5, 95.5});
    ASSERT_TRUE(slice);
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 p = border_point(slice->outline, k) - glm::dvec2(120.5, 100.5);
        EXPECT_NEAR(glm::length(p), radius(std::atan2(p.y, p.x)), 4.0) << k;
    }
    ThesisOptions off;
    off.turn_rule = TurnRule::Off;
    off.greatest_radius = 1;
    const auto unfiltered = SliceTracer(mask, off).trace({110.5, 95.5});
    ASSERT_TRUE(unfiltered);
    EXPECT_GT(outline_area(unfiltered->outline), 1.1 * outline_area(slice->outline));
}

class RandomMasks : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomMasks, DepthIsTheLeastRadiusAndSlicesAreStarShaped) {
    Rng rng({.seed = GetParam()});
    Mask mask(160, 160);
    for (int i = 0; i < 9; ++i)
        test::draw_circle(mask, {rng.uniform(10, 150), rng.uniform(10, 150)}, rng.uniform(10, 50));
    const SliceTracer tracer(mask, {});
    int n_found = 0;
    for (int i = 0; i < 60; ++i) {
        const auto slice = tracer.trace({rng.uniform(0, 160), rng.uniform(0, 160)});
        if (!slice)
            continue;
        ++n_found;
        const auto& radii = slice->outline.radii;
        EXPECT_EQ(slice->depth, *std::min_element(radii.begin(), radii.end()));
        EXPECT_GT(slice->depth, 0.0F);
        EXPECT_GE(outline_area(slice->outline), 30.0);
        EXPECT_GE(slice->retained_share, 0.3);
    }
    EXPECT_GT(n_found, 3);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomMasks, testing::Range<std::uint64_t>(0, 6));

TEST(SliceTracer, RaysOutOfThePictureMarkTheRock) {
    Mask mask(100, 100);
    test::draw_circle(mask, {50.5, 12.5}, 25);
    const auto slice = SliceTracer(mask, {}).trace({50.5, 12.5});
    ASSERT_TRUE(slice);
    EXPECT_TRUE(slice->outline.touches_border);
    EXPECT_LT(slice->outline.confidence, 0.95F);
}

TEST(SliceTracer, LiteralDepthComesFromTheHits) {
    Mask mask(100, 100);
    test::draw_circle(mask, {50.5, 50.5}, 25);
    ThesisOptions options;
    options.depth_from = DepthFrom::Hits;
    options.inset = 2;
    const auto slice = SliceTracer(mask, options).trace({50.5, 50.5});
    ASSERT_TRUE(slice);
    EXPECT_NEAR(slice->depth, 25, 1);
    EXPECT_NEAR(slice->outline.radii[7], 23, 1);
}

TEST(SliceTracer, GapsOverHalfATurnReject) {
    Mask mask(100, 100);
    test::draw_curve(
        mask, {50.5, 50.5}, [](double) { return 25.0; }, 0, 200);
    EXPECT_FALSE(SliceTracer(mask, {}).trace({50.5, 40.5}));
}

}  // namespace
}  // namespace scree::vision
