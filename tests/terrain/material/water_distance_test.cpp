#include "terrain/material/water_distance.h"

#include "base/parallel.h"
#include "base/random.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

Heightfield random_ground(int width, int height, std::uint64_t seed, double wet) {
    Rng rng({.seed = seed});
    Heightfield ground{FloatRaster(width, height), 0.5};
    for (float& value : ground.heights)
        value = rng.uniform() < wet ? 0.0F : 1.0F;
    return ground;
}

TEST(WaterDistance, EqualsTheSearchOfAllCells) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const Heightfield ground = random_ground(29, 17, seed, seed % 2 == 0 ? 0.02 : 0.3);
        const FloatRaster distance = water_distance(ground, 0.0);
        for (int y = 0; y < 17; ++y)
            for (int x = 0; x < 29; ++x) {
                double nearest = std::numeric_limits<double>::infinity();
                for (int v = 0; v < 17; ++v)
                    for (int u = 0; u < 29; ++u)
                        if (ground.heights(u, v) <= 0.0F)
                            nearest = std::min(nearest, 0.5 * std::hypot(u - x, v - y));
                EXPECT_FLOAT_EQ(distance(x, y), static_cast<float>(nearest));
            }
    }
}

TEST(WaterDistance, IsInfiniteWithoutWater) {
    const FloatRaster distance = water_distance(random_ground(5, 4, 1, 0.0), -1.0);
    for (const float value : distance)
        EXPECT_TRUE(std::isinf(value));
}

TEST(WaterDistance, IsTheSameForAnyThreadCount) {
    const Heightfield ground = random_ground(200, 150, 3, 0.01);
    const FloatRaster many = water_distance(ground, 0.0);
    const ThreadLimit one(1);
    EXPECT_EQ(water_distance(ground, 0.0), many);
}

}  // namespace
}  // namespace scree::terrain
