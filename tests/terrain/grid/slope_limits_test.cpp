#include "terrain/grid/slope_limits.h"

#include "base/error.h"
#include "tests/support/sand_piles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

TEST(SlopeLimits, TakeTheReposeOfTheHigherCell) {
    const Heightfield base{FloatRaster(2, 2), 0.5};
    const SoilTile soil = test::two_soils(2, 30, 40);
    const SlopeLimits limits = slope_limits(base, soil, true);
    EXPECT_FLOAT_EQ(limits.rise_x(0, 0), 0.5F * soil.tan_repose(1, 0));  // the right one is higher
    EXPECT_FLOAT_EQ(limits.fall_x(0, 1), 0.5F * soil.tan_repose(0, 1));
    EXPECT_FLOAT_EQ(limits.rise_z(0, 0), 0.5F * soil.tan_repose(0, 0));
    EXPECT_FLOAT_EQ(limits.fall_z(1, 0), 0.5F * soil.tan_repose(1, 0));
}

TEST(SlopeLimits, KeepABaseThatIsSteeperOnlyIfAsked) {
    Heightfield base{FloatRaster(2, 2), 1.0};
    base.heights(1, 0) = 7.0F;
    const SoilTile soil = test::two_soils(2, 30, 30);
    const SlopeLimits kept = slope_limits(base, soil, true);
    EXPECT_GE(kept.rise_x(0, 0), 7.0F);
    EXPECT_NEAR(kept.rise_x(0, 0), 7.0, 1e-5);
    EXPECT_GE(kept.fall_z(1, 0), 7.0F);
    EXPECT_FLOAT_EQ(slope_limits(base, soil, false).rise_x(0, 0), soil.tan_repose(0, 0));
    const DoubleRaster heights = total_heights(base, FloatRaster(2, 2));
    EXPECT_EQ(greatest_excess(heights, kept, 1.0), 0.0);
}

TEST(SlopeLimits, ExcessIsASlope) {
    const Heightfield base{FloatRaster(3, 2), 0.5};
    SoilTile soil = test::two_soils(3, 0, 0);
    soil.tan_repose = FloatRaster(3, 2, 0.25F);
    const SlopeLimits limits = slope_limits(base, soil, false);
    DoubleRaster heights(3, 2);
    heights(2, 1) = 1.5;  // a slope of 3 to both neighbours
    EXPECT_DOUBLE_EQ(greatest_excess(heights, limits, 0.5), 2.75);
    heights(2, 1) = 0.1;
    EXPECT_DOUBLE_EQ(greatest_excess(heights, limits, 0.5), 0.0);
}

TEST(SlopeLimits, DisplacementKeepsItsBitsWhereNothingMoved) {
    const Heightfield base{FloatRaster(2, 2, 1e6F), 1.0};
    FloatRaster u(2, 2, 0.1F);
    const DoubleRaster before = total_heights(base, u);
    DoubleRaster after = before;
    after(1, 1) += 2.0;
    store_displacement(before, after, base, u);
    EXPECT_EQ(u(0, 0), 0.1F);
    EXPECT_FLOAT_EQ(u(1, 1), 2.1F);
}

}  // namespace
}  // namespace scree::terrain
