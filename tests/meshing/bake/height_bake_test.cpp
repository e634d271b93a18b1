#include "meshing/bake/height_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "tests/support/placed_rocks.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

// Part E, one pixel at a time, with the library's own arc tangent.
float brute_force_height(const vision::RockSet& set, int x, int y) {
    double best = 0.0;
    for (const vision::Rock& rock : set.rocks) {
        const double dx = x + 0.5 - rock.outline.centre.x;
        const double dy = y + 0.5 - rock.outline.centre.y;
        const double r = vision::radius_at(rock.outline, std::atan2(dy, dx));
        const double rest = 1.0 - (dx * dx + dy * dy) / (r * r);
        if (rest > 0.0)
            best = std::max(best, rock.depth * std::sqrt(rest) * scale_of(set));
    }
    return static_cast<float>(best);
}

class HeightBake : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(HeightBake, EqualsTheClosedFormAtEveryPixel) {
    const auto set = test::scattered_rocks(131, 97, 40, 3.0, 30.0, GetParam());
    const auto map = bake_displacement(set);
    ASSERT_EQ(map.metres.width(), 131);
    ASSERT_EQ(map.metres.height(), 97);
    EXPECT_EQ(map.metres_per_pixel, 0.002);
    for (int y = 0; y < 97; ++y)
        for (int x = 0; x < 131; ++x) {
            const double wanted = brute_force_height(set, x, y);
            // Next to a border the square root turns rounding of 1e-6 into 1e-3 of the depth.
            const double tolerance = wanted > 0.01 ? 2e-6 : 1.2e-4;
            ASSERT_NEAR(map.metres(x, y), wanted, tolerance) << x << ", " << y;
        }
}
INSTANTIATE_TEST_SUITE_P(Seeds, HeightBake, testing::Range(0U, 6U));

TEST(HeightBakeShape, SphereRisesToItsDepthInMetres) {
    vision::RockSet set = test::empty_picture(41, 31, 0.01);
    vision::Rock rock;
    rock.outline.centre = {20.5, 15.5};
    rock.outline.radii.fill(10.0F);
    rock.depth = 10.0F;
    set.rocks.push_back(rock);
    const auto map = bake_displacement(set);
    EXPECT_FLOAT_EQ(map.metres(20, 15), 0.1F);
    EXPECT_NEAR(map.metres(26, 15), 0.08F, 1e-7);  // 3-4-5: 6 px out, 8 px up
    EXPECT_NEAR(map.metres(20, 7), 0.06F, 1e-7);
    EXPECT_EQ(map.metres(31, 15), 0.0F);
    EXPECT_EQ(map.metres(0, 0), 0.0F);
}

TEST(HeightBakeShape, UnknownScaleTakesTheAssumedOne) {
    auto set = test::scattered_rocks(20, 20, 1, 5.0, 6.0, 1);
    set.metres_per_pixel = 0.0;
    EXPECT_EQ(bake_displacement(set).metres_per_pixel, vision::kAssumedMetresPerPixel);
}

TEST(HeightBakeShape, NoRockIsFlatGroundAndFarRocksLeaveNoTrace) {
    vision::RockSet set = test::empty_picture(5, 3, 0.01);
    EXPECT_EQ(bake_displacement(set).metres, FloatRaster(5, 3));
    set.rocks.push_back(test::lobed_rock({-500.0, 9000.0}, 20.0, 2));
    EXPECT_EQ(bake_displacement(set).metres, FloatRaster(5, 3));
}

TEST(HeightBakeShape, SameBytesForEveryThreadCount) {
    const auto set = test::scattered_rocks(300, 400, 200, 3.0, 60.0, 7);
    const ThreadLimit one(1);
    const auto alone = bake_displacement(set);
    const ThreadLimit more(0);
    EXPECT_EQ(bake_displacement(set).metres, alone.metres);
}

TEST(HeightBakeErrors, NameTheRockOrTheSize) {
    auto set = test::scattered_rocks(20, 20, 3, 5.0, 6.0, 1);
    set.rocks[1].outline.radii[8] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT([&] { bake_displacement(set); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("rock 1 has")));
    set = test::scattered_rocks(20, 20, 3, 5.0, 6.0, 1);
    set.rocks[2].depth = -1.0F;
    EXPECT_THROW(bake_displacement(set), InvalidInput);
    set.rocks.clear();
    set.width = 0;
    EXPECT_THROW(bake_displacement(set), InvalidInput);
    set.width = set.height = 1 << 20;
    EXPECT_THAT([&] { bake_displacement(set); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("1048576 x 1048576")));
}

}  // namespace
}  // namespace scree::meshing
