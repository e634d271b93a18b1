#include "terrain/grid/slope_envelopes.h"

#include "tests/support/sand_piles.h"

#include <numeric>

#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

SlopeLimits rough_limits(int width, int height, unsigned seed) {
    return {test::rough_heights(width, height, 1.0F, seed),
            test::rough_heights(width, height, 1.0F, seed + 1),
            test::rough_heights(width, height, 1.0F, seed + 2),
            test::rough_heights(width, height, 1.0F, seed + 3)};
}

DoubleRaster rough(int width, int height, unsigned seed) {
    const FloatRaster values = test::rough_heights(width, height, 10.0F, seed);
    DoubleRaster heights(width, height);
    std::copy(values.begin(), values.end(), heights.begin());
    return heights;
}

class Envelopes : public testing::TestWithParam<unsigned> {};

TEST_P(Envelopes, EndWithinLimitsWithTheSameSum) {
    const SlopeLimits limits = rough_limits(20, 31, 10 * GetParam());
    DoubleRaster heights = rough(20, 31, GetParam() + 77);
    const double before = std::accumulate(heights.begin(), heights.end(), 0.0);
    const EnvelopeReport report = bring_within_limits(heights, limits, 1.0);
    EXPECT_LE(greatest_excess(heights, limits, 1.0), 1e-8);
    EXPECT_NEAR(std::accumulate(heights.begin(), heights.end(), 0.0), before, 1e-9 * before);
    EXPECT_GE(report.areas, 1);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Envelopes, testing::Range(0U, 6U));

TEST(Envelopes, TwoCellsMeetInTheMiddle) {
    const FloatRaster limit(2, 2, 1.0F);
    DoubleRaster heights(2, 2);
    heights(1, 0) = heights(1, 1) = 4.0;
    bring_within_limits(heights, {limit, limit, limit, limit}, 1.0);
    for (int y = 0; y < 2; ++y) {
        EXPECT_NEAR(heights(0, y), 1.5, 1e-9);
        EXPECT_NEAR(heights(1, y), 2.5, 1e-9);
    }
}

TEST(Envelopes, SpikesFarApartKeepTheirVolumesApart) {
    const FloatRaster limit(40, 9, 1.0F);
    DoubleRaster heights(40, 9);
    heights(4, 4) = 2.5;
    heights(34, 4) = 1.5;
    const EnvelopeReport report = bring_within_limits(heights, {limit, limit, limit, limit}, 1.0);
    EXPECT_EQ(report.areas, 2);
    double left = 0.0;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 20; ++x)
            left += heights(x, y);
    EXPECT_NEAR(left, 2.5, 1e-9);
}

TEST(Envelopes, GroundAtRestKeepsItsBits) {
    const FloatRaster limit(12, 12, 20.0F);
    DoubleRaster heights = rough(12, 12, 4);
    const DoubleRaster before = heights;
    EXPECT_EQ(bring_within_limits(heights, {limit, limit, limit, limit}, 1.0).areas, 0);
    EXPECT_EQ(heights, before);
}

}  // namespace
}  // namespace scree::terrain
