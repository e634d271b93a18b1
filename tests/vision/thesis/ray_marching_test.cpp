#include "vision/thesis/ray_marching.h"

#include "base/random.h"
#include "tests/vision/thesis/masks.h"
#include "vision/thesis/sampling.h"

#include <set>
#include <utility>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(RayMarching, FindsTheRadiusOfADrawnCircle) {
    for (const double radius : {5.0, 17.3, 60.0}) {
        Mask mask(150, 150);
        test::draw_circle(mask, {74.6, 75.2}, radius);
        const RayCaster caster(mask);
        for (const glm::dvec2 d : ray_directions(360)) {
            const auto hit = caster.cast({74.6, 75.2}, d);
            ASSERT_TRUE(hit);
            const glm::dvec2 p = glm::dvec2(hit->pixel) + 0.5 - glm::dvec2(74.6, 75.2);
            EXPECT_NEAR(std::hypot(p.x, p.y), radius, 1.0);
            EXPECT_NEAR(hit->distance, radius, 1.5);  // where the ray enters the pixel
            EXPECT_NE(mask(hit->pixel.x, hit->pixel.y), 0);
        }
    }
}

TEST(RayMarching, NothingLeaksThroughEightConnectedCurves) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Rng rng({.seed = seed});
        Mask mask(200, 200);
        const double phase = rng.uniform(0, 6);
        test::draw_curve(mask, {100, 100},
                         [&](double a) { return 60 + 12 * std::cos(3 * a + phase); });
        const RayCaster caster(mask);
        for (int i = 0; i < 40; ++i) {
            const glm::dvec2 origin{rng.uniform(75, 125), rng.uniform(75, 125)};
            for (const glm::dvec2 d : ray_directions(90)) {
                const auto hit = caster.cast(origin, d);
                ASSERT_TRUE(hit);
                ASSERT_LT(hit->distance, 110);
            }
        }
    }
}

TEST(RayMarching, DiagonalPairStopsARayThroughItsCorner) {
    Mask mask(20, 20);
    for (int i = 0; i < 20; ++i)
        mask(i, i) = 1;
    const RayCaster caster(mask);
    const double s = std::sqrt(0.5);
    const auto hit = caster.cast({15.0, 5.0}, {-s, s});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 5.0 * std::sqrt(2.0), 1e-9);
}

// Fine steps see every pixel that the exact traversal sees, bar corners clipped by less than a
// step; so no first hit may come later than theirs.
TEST(RayMarching, AgreesWithFineSteps) {
    Rng rng({.seed = 5});
    Mask mask(80, 60);
    for (int i = 0; i < 150; ++i)
        mask(static_cast<int>(rng.below(80)), static_cast<int>(rng.below(60))) = 1;
    const RayCaster caster(mask);
    int n_differing = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 o{rng.uniform(0, 80), rng.uniform(0, 60)};
        const double a = rng.uniform(0, 2 * std::numbers::pi);
        const glm::dvec2 d{std::cos(a), std::sin(a)};
        double t = 0.0;
        const auto at = [&] {
            return glm::ivec2(std::floor(o.x + t * d.x), std::floor(o.y + t * d.y));
        };
        while (mask.contains(at().x, at().y) && mask(at().x, at().y) == 0)
            t += 0.002;
        const auto hit = caster.cast(o, d);
        const bool stepped_hit = mask.contains(at().x, at().y);
        if (hit && stepped_hit && std::abs(hit->distance - t) < 0.01)
            continue;
        if (!hit && !stepped_hit)
            continue;
        ++n_differing;
        ASSERT_TRUE(hit);
        ASSERT_LT(hit->distance, t + 0.01);
    }
    EXPECT_LT(n_differing, 10);
}

TEST(RayMarching, LeavingThePictureIsNoHit) {
    const RayCaster caster(Mask(30, 20));
    for (const glm::dvec2 d : ray_directions(90))
        EXPECT_FALSE(caster.cast({10, 10}, d));
    EXPECT_FALSE(caster.is_open({-0.1, 3}));
    EXPECT_FALSE(caster.is_open({30, 3}));
    EXPECT_FALSE(caster.is_open({std::nan(""), 3}));
    EXPECT_TRUE(caster.is_open({29.9, 19.9}));
}

// A ray that runs along a pixel border once set its own progress back and never ended.
TEST(RayMarching, RaysAlongPixelBordersEnd) {
    Mask mask(50, 50);
    mask(25, 40) = 1;
    mask(23, 12) = 1;
    mask(26, 30) = 1;
    const RayCaster caster(mask);
    for (int y = 1; y < 50; ++y)
        for (const glm::dvec2 d : ray_directions(360))
            caster.cast({25.0, static_cast<double>(y)}, d);
    SUCCEED();
}

TEST(Sampling, GridHasOneNodePerSpacing) {
    EXPECT_EQ(grid_nodes(900, 600, 5).size(), 21600U);
    EXPECT_EQ(grid_nodes(3, 2, 5).size(), 1U);
    std::set<std::pair<int, int>> seen;
    for (const glm::ivec2 p : grid_nodes(903, 17, 5)) {
        EXPECT_TRUE(p.x >= 0 && p.x < 903 && p.y >= 0 && p.y < 17);
        EXPECT_TRUE(seen.emplace(p.x, p.y).second);
    }
}

TEST(Sampling, EdgeNodesAreSkippedAndOrderIsByDepth) {
    Mask mask(100, 100);
    test::draw_circle(mask, {50, 50}, 40);
    const RayCaster caster(mask);
    ThesisOptions options;
    const auto rows = visiting_order(caster, options);
    EXPECT_LT(rows.size(), 400U);
    for (const glm::ivec2 p : rows)
        EXPECT_EQ(mask(p.x, p.y), 0);
    options.order = VisitOrder::DeepestFirst;
    const auto deep = visiting_order(caster, options);
    EXPECT_EQ(deep.size(), rows.size());
    for (std::size_t i = 1; i < deep.size(); ++i)
        EXPECT_GE(caster.clearance(deep[i - 1].x, deep[i - 1].y),
                  caster.clearance(deep[i].x, deep[i].y));
}

}  // namespace
}  // namespace scree::vision
