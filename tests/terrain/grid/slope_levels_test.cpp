#include "terrain/grid/slope_levels.h"

#include "tests/support/sand_piles.h"

#include <numeric>

#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

DoubleRaster heights_of(const FloatRaster& values) {
    DoubleRaster heights(values.width(), values.height());
    std::copy(values.begin(), values.end(), heights.begin());
    return heights;
}

double sum_of(const DoubleRaster& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

SlopeLevels levels_of(const FloatRaster& heights, float limit) {
    const FloatRaster limits(heights.width(), heights.height(), limit);
    return {heights_of(heights), {limits, limits, limits, limits}};
}

class SlopeLevelsSeeds : public testing::TestWithParam<unsigned> {};

TEST_P(SlopeLevelsSeeds, CyclesKeepTheSumOnGridsOfAnyShape) {
    const int width = 17 + static_cast<int>(GetParam()) * 3;
    const int height = 40 - static_cast<int>(GetParam()) * 5;
    SlopeLevels levels = levels_of(test::rough_heights(width, height, 50.0F, GetParam()), 0.3F);
    const double before = sum_of(levels.heights());
    const double excess = greatest_excess(levels.heights(), levels.limits(), 1.0);
    for (int cycle = 0; cycle < 5; ++cycle)
        levels.cycle(2, 1.3);
    EXPECT_NEAR(sum_of(levels.heights()), before, 1e-12 * before);
    EXPECT_LT(greatest_excess(levels.heights(), levels.limits(), 1.0), 0.25 * excess);
}
INSTANTIATE_TEST_SUITE_P(Seeds, SlopeLevelsSeeds, testing::Range(0U, 5U));

TEST(SlopeLevels, LeaveGroundAtRestAlone) {
    FloatRaster ramp(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            ramp(x, y) = 0.5F * static_cast<float>(x + y);
    SlopeLevels levels = levels_of(ramp, 0.5F);
    levels.cycle(4, 1.3);
    EXPECT_EQ(levels.heights(), heights_of(ramp));
}

TEST(SlopeLevels, CountACoarsePassByItsCells) {
    SlopeLevels levels = levels_of(test::rough_heights(16, 16, 1.0F, 1), 0.1F);
    // Levels of 16, 8 and 4 cells a side; making the two coarse ones reads 1 + 1/4 grids.
    EXPECT_DOUBLE_EQ(levels.passes(), 1.25);
    levels.cycle(3, 1.0);
    // Six passes on each, and one more where a coarser level is read and answers.
    EXPECT_DOUBLE_EQ(levels.passes(), 1.25 + 7.0 + 7.0 / 4 + 6.0 / 16);
}

TEST(SlopeLevels, CarryAWidePileFurtherThanPassesOnOneLevelCould) {
    FloatRaster step(128, 128);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 64; ++x)
            step(x, y) = 10.0F;
    SlopeLevels levels = levels_of(step, 0.0F);
    for (int cycle = 0; cycle < 10; ++cycle)
        levels.cycle(2, 1.3);
    EXPECT_NEAR(levels.heights()(0, 8), 5.0, 1.0);
    EXPECT_NEAR(levels.heights()(127, 8), 5.0, 1.0);
}

}  // namespace
}  // namespace scree::terrain
