#include "vision/thesis/polygon.h"

#include "base/random.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

const std::vector<glm::dvec2> kSquare{{10, 10}, {30, 10}, {30, 30}, {10, 30}};

std::vector<glm::dvec2> lobed(std::uint64_t seed) {
    Rng rng({.seed = seed});
    std::vector<glm::dvec2> points;
    const double phase = rng.uniform(0, 6);
    for (int k = 0; k < 120; ++k) {
        const double a = 2 * std::numbers::pi * k / 120;
        const double r = 20 + 6 * std::cos(3 * a + phase);
        points.emplace_back(40.3 + r * std::cos(a), 35.8 + r * std::sin(a));
    }
    return points;
}

TEST(Polygon, AreaAndCentroids) {
    EXPECT_DOUBLE_EQ(signed_area(kSquare), 400);
    EXPECT_NEAR(area_centroid(kSquare).x, 20, 1e-12);
    auto uneven = kSquare;
    for (int i = 1; i < 10; ++i)
        uneven.insert(uneven.begin() + i, {10 + 2.0 * i, 10});
    EXPECT_NEAR(area_centroid(uneven).y, 20, 1e-9) << "uneven spacing does not move it";
    EXPECT_LT(vertex_mean(uneven).y, 15) << "the plain mean it does move";
    const std::vector<glm::dvec2> flat{{0, 0}, {4, 0}, {2, 0}};
    EXPECT_NEAR(area_centroid(flat).x, 2, 1e-12);
}

TEST(Polygon, RunsEqualTheInsideTestPixelByPixel) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const auto polygon = lobed(seed);
        Mask painted(60, 60);
        for_each_inside_run(polygon, 60, 60, [&](int y, int from, int to) {
            for (int x = from; x < to; ++x)
                painted(x, y) = 1;
        });
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 60; ++x)
                ASSERT_EQ(painted(x, y) != 0, is_inside(polygon, {x + 0.5, y + 0.5}));
    }
}

TEST(Polygon, RadiiOfASquareAreExact) {
    const auto radii = polygon_radii(kSquare, {20, 20});
    ASSERT_TRUE(radii);
    for (std::size_t k = 0; k < kRadii; ++k) {
        const double a = static_cast<double>(k) * std::numbers::pi / 180;
        const double r = 10 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
        EXPECT_NEAR((*radii)[k], r, 1e-4) << k;
    }
    EXPECT_FALSE(polygon_radii(kSquare, {50, 20})) << "centre outside";
}

TEST(Polygon, NearestCrossingIsTaken) {
    // A dent on the right: at azimuth 0 the outline is crossed three times.
    const std::vector<glm::dvec2> dented{{-10, -10}, {30, -10}, {30, -2}, {5, -2},
                                         {5, -1},    {20, 1},   {20, 2},  {-10, 10}};
    const auto radii = polygon_radii(dented, {0, 0});
    ASSERT_TRUE(radii);
    EXPECT_NEAR((*radii)[0], 12.5, 1e-4);
}

}  // namespace
}  // namespace scree::vision
