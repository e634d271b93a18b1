#include "meshing/rocks/spherical_worley.h"

#include "base/error.h"
#include "base/random.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

glm::dvec3 direction(Rng& rng) {
    const double y = rng.uniform(-1, 1);
    const double a = rng.uniform(0, 2 * std::numbers::pi);
    const double out = std::sqrt(1 - y * y);
    return {out * std::cos(a), y, out * std::sin(a)};
}

TEST(SphericalWorley, EqualsLookingAtEveryPoint) {
    for (const int n : {3, 4, 24, 500}) {
        const SphericalWorley noise(n, 7);
        Rng rng({.seed = 1, .stream = 5});
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 u = i == 0   ? glm::dvec3(0, 1, 0)
                                 : i == 1 ? glm::dvec3(0, -1, 0)
                                 : i < 5  ? noise.points()[static_cast<std::size_t>(i - 2)]
                                          : direction(rng);
            const WorleyDistances fast = noise.distances(u);
            const WorleyDistances slow = noise.distances_by_search(u);
            ASSERT_EQ(fast.first, slow.first) << n << " points, direction " << i;
            ASSERT_EQ(fast.second, slow.second);
            ASSERT_EQ(fast.third, slow.third);
            ASSERT_LE(fast.first, fast.second);
            ASSERT_LE(fast.second, fast.third);
        }
    }
}

TEST(SphericalWorley, IsContinuous) {
    const SphericalWorley noise(24, 3);
    Rng rng({.seed = 2, .stream = 5});
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 u = direction(rng);
        const glm::dvec3 v = glm::normalize(u + 1e-4 * direction(rng));
        EXPECT_NEAR(noise.distances(u).first, noise.distances(v).first, 1.1e-4);
        EXPECT_NEAR(noise.distances(u).third, noise.distances(v).third, 1.1e-4);
    }
}

TEST(SphericalWorley, PointsAreUnitOrderedAndSpread) {
    for (const int n : {3, 24, 300}) {
        const auto points = scatter_on_sphere(n, 11);
        ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
        glm::dvec3 mean(0.0);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_NEAR(glm::length(points[i]), 1.0, 1e-12);
            EXPECT_LE(points[i == 0 ? 0 : i - 1].y, points[i].y);
            mean += points[i] / static_cast<double>(n);
        }
        EXPECT_LT(glm::length(mean), 1.0 / std::sqrt(n));
    }
}

TEST(SphericalWorley, SeedsDecide) {
    EXPECT_EQ(scatter_on_sphere(24, 5), scatter_on_sphere(24, 5));
    EXPECT_NE(scatter_on_sphere(24, 5), scatter_on_sphere(24, 6));
}

TEST(SphericalWorleyErrors, NameTheValue) {
    EXPECT_THAT([] { scatter_on_sphere(2, 1); },
                testing::ThrowsMessage<InvalidOption>("points is 2, must be in [3, 1000000]"));
}

}  // namespace
}  // namespace scree::meshing
