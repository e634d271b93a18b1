#include "terrain/contact/footing.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

constexpr double kSize = 0.02;
constexpr CellGrid kGrid{{0, 0, 100, 100}, kSize};

FloatRaster level(const CellWindow& window, float height) {
    return FloatRaster(window.width, window.height, height);
}

TEST(Footing, KeepsTheGroundThatAnObjectPressedAway) {
    Footing footing;
    const Underside ball = underside_of_sphere({1, 0.3, 1}, 0.4, kGrid);
    FloatRaster ground = level(ball.window, 0.0F);
    follow(footing, ball, ground);
    EXPECT_EQ(footing.heights, ground);
    for (std::size_t i = 0; i < ground.size(); ++i)  // dug to the underside, with a rim outside
        ground.data()[i] = ball.heights.data()[i] < 0.0F ? ball.heights.data()[i] : 0.01F;
    follow(footing, ball, ground);
    EXPECT_EQ(footing.heights(20, 20), 0.0F);
    EXPECT_EQ(footing.heights(0, 0), 0.01F);  // not the object's: the rim is ground to stand on
    const Underside lifted = underside_of_sphere({1, 0.6, 1}, 0.4, kGrid);
    follow(footing, lifted, ground);
    EXPECT_EQ(footing.heights(20, 20), ground(20, 20));  // let go
}

TEST(Footing, SinksToTheDepthAskedFor) {
    Footing footing;
    const Underside ball = underside_of_sphere({1, 0.7, 1}, 0.4, kGrid);
    follow(footing, ball, level(ball.window, 0.1F));
    EXPECT_NEAR(raise_to_sink(footing, ball, 0.05), 0.1 - 0.3 - 0.05, 1e-3);
}

// A ball in a Winkler bed: the load is the stiffness times the cap's volume.
TEST(Footing, BearsAWeightByTheCapBelowTheGround) {
    Footing footing;
    const double radius = 0.4;
    const Underside ball = underside_of_sphere({1, 1.0, 1}, radius, kGrid);
    follow(footing, ball, level(ball.window, 0.0F));
    const double depth = 0.06;
    const double cap = std::numbers::pi * depth * depth * (radius - depth / 3);
    const FloatRaster stiffness = level(ball.window, 2e5F);
    const double raise = raise_to_bear(footing, ball, stiffness, kSize, 2e5 * cap);
    EXPECT_NEAR(1.0 - radius + raise, -depth, 0.02 * depth);
    EXPECT_NEAR(raise_to_bear(footing, ball, stiffness, kSize, 0.0), -0.6, 1e-3);
}

TEST(Footing, AnObjectOverNoCellIsLeftWhereItIs) {
    Footing footing;
    const Underside grain = underside_of_sphere({1, 0, 1}, 0.001, kGrid);
    follow(footing, grain, level(grain.window, 0.0F));
    EXPECT_EQ(raise_to_sink(footing, grain, 0.1), 0.0);
    EXPECT_EQ(raise_to_bear(footing, grain, level(grain.window, 1.0F), kSize, 5), 0.0);
}

}  // namespace
}  // namespace scree::terrain
