#include "terrain/view/ranges.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

constexpr ViewRanges kRanges{2.0F, 8.0F};

TEST(Ranges, AreHalfOpenAtTheNearRadiusAndClosedAtTheFarOne) {
    EXPECT_EQ(range_at(0.0F, kRanges), ViewRange::Near);
    EXPECT_EQ(range_at(std::nextafter(2.0F, 0.0F), kRanges), ViewRange::Near);
    EXPECT_EQ(range_at(2.0F, kRanges), ViewRange::Middle);
    EXPECT_EQ(range_at(8.0F, kRanges), ViewRange::Middle);
    EXPECT_EQ(range_at(std::nextafter(8.0F, 9.0F), kRanges), ViewRange::Far);
}

TEST(Ranges, SharesFallWithoutAJumpAndEndAtTheBorders) {
    for (const auto share : {mesh_share, displacement_share}) {
        float before = share(0.0F, kRanges);
        EXPECT_EQ(before, 1.0F);
        for (float d = 0.0F; d < 10.0F; d += 0.001F) {
            const float now = share(d, kRanges);
            EXPECT_LE(now, before);
            EXPECT_LT(before - now, 0.004F);
            before = now;
        }
        EXPECT_EQ(before, 0.0F);
    }
    EXPECT_EQ(mesh_share(2.0F, kRanges), 0.0F);
    EXPECT_EQ(mesh_share(1.5F, kRanges), 1.0F);
    EXPECT_EQ(displacement_share(8.0F, kRanges), 0.0F);
    EXPECT_EQ(displacement_share(6.0F, kRanges), 1.0F);
}

TEST(Ranges, ARadiusOfZeroLeavesNothingNear) {
    EXPECT_EQ(mesh_share(0.0F, {0.0F, 1.0F}), 0.0F);
    EXPECT_EQ(range_at(0.0F, {0.0F, 1.0F}), ViewRange::Middle);
}

}  // namespace
}  // namespace scree::terrain
