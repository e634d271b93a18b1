#include "meshing/bake/ambient_occlusion.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/bake/height_bake.h"
#include "tests/support/placed_rocks.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

// A funnel about the middle pixel whose walls rise at `slope`.
vision::HeightImage funnel(int size, double slope) {
    vision::HeightImage heights{FloatRaster(size, size), 0.01};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            heights.metres(x, y) =
                static_cast<float>(0.01 * slope * std::hypot(x - size / 2, y - size / 2));
    return heights;
}

TEST(AmbientOcclusion, FlatGroundSeesTheWholeSky) {
    for (const std::uint8_t v : ambient_occlusion({FloatRaster(50, 30, 0.7F), 0.01}))
        ASSERT_EQ(v, 255);
}

TEST(AmbientOcclusion, FunnelSeesTheSquaredCosineOfItsSlope) {
    for (const double slope : {0.25, 1.0, 3.0}) {
        const auto map = ambient_occlusion(funnel(201, slope), {.directions = 16});
        const double wanted = 255.0 / (1.0 + slope * slope);
        EXPECT_NEAR(map(100, 100), wanted, 0.02 * 255.0) << slope;
    }
}

TEST(AmbientOcclusion, FootOfAWallLosesHalfAndTheTopLosesNothing) {
    vision::HeightImage heights{FloatRaster(200, 100), 0.01};
    for (int y = 0; y < 100; ++y)
        for (int x = 100; x < 200; ++x)
            heights.metres(x, y) = 100.0F;
    const auto map = ambient_occlusion(heights, {.directions = 32});
    EXPECT_NEAR(map(99, 50), 127.5, 0.04 * 255.0);  // the wall hides one half of the azimuths
    EXPECT_EQ(map(100, 50), 255);
    EXPECT_EQ(map(10, 50), 255);  // out of reach
}

TEST(AmbientOcclusion, GapsBetweenRocksAreDarkerThanTheirTops) {
    const auto set = test::scattered_rocks(200, 150, 60, 8.0, 20.0, 4);
    const auto heights = bake_displacement(set);
    const auto map = ambient_occlusion(heights);
    double ground = 0.0;
    double tops = 0.0;
    int n_ground = 0;
    int n_tops = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        const float h = heights.metres.data()[i];
        if (h == 0.0F) {
            ground += map.data()[i];
            ++n_ground;
        } else if (h > 0.02F) {
            tops += map.data()[i];
            ++n_tops;
        }
    }
    EXPECT_LT(ground / n_ground, 0.85 * tops / n_tops);
}

TEST(AmbientOcclusion, ReducedWorkStaysCloseToFullWork) {
    const auto heights = bake_displacement(test::scattered_rocks(300, 225, 40, 15.0, 40.0, 6));
    const auto full = ambient_occlusion(heights, {.working_pixels = 1e9});
    const auto half = ambient_occlusion(heights, {.working_pixels = 2e4});
    ASSERT_EQ(half.width(), 300);
    ASSERT_EQ(half.height(), 225);
    double sum = 0.0;
    for (std::size_t i = 0; i < full.size(); ++i)
        sum += std::abs(full.data()[i] - half.data()[i]);
    EXPECT_LT(sum / static_cast<double>(full.size()), 8.0);
}

TEST(AmbientOcclusion, WrappingMapsShiftWithTheirHeights) {
    const auto heights = bake_displacement(test::scattered_rocks(96, 64, 20, 5.0, 15.0, 8));
    vision::HeightImage shifted = heights;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x)
            shifted.metres((x + 40) % 96, (y + 20) % 64) = heights.metres(x, y);
    const AmbientOcclusionOptions options{.reach_px = 200.0, .wraps = true};
    const auto map = ambient_occlusion(heights, options);
    const auto moved = ambient_occlusion(shifted, options);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x)
            ASSERT_EQ(moved((x + 40) % 96, (y + 20) % 64), map(x, y));
}

TEST(AmbientOcclusion, SameBytesForEveryThreadCount) {
    const auto heights = bake_displacement(test::scattered_rocks(150, 170, 60, 5.0, 15.0, 8));
    const ThreadLimit one(1);
    const auto alone = ambient_occlusion(heights);
    const ThreadLimit more(0);
    EXPECT_EQ(ambient_occlusion(heights), alone);
}

TEST(AmbientOcclusionErrors, NameTheScaleOrTheValue) {
    EXPECT_THROW(ambient_occlusion({FloatRaster(2, 2), 0.0}), InvalidInput);
    EXPECT_THROW(ambient_occlusion({FloatRaster(), 0.01}), InvalidInput);
    EXPECT_THROW(ambient_occlusion({FloatRaster(2, 2, NAN), 0.01}), InvalidInput);
    EXPECT_THAT(
        [] {
            ambient_occlusion({FloatRaster(2, 2), 0.01}, {.directions = 1});
        },
        testing::ThrowsMessage<InvalidOption>("directions is 1, must be in [4, 64]"));
}

}  // namespace
}  // namespace scree::meshing
