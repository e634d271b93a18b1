#include "meshing/space/delaunay.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::triangulate_plan;
using testing::HasSubstr;
using testing::ThrowsMessage;

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area_of(const std::vector<glm::dvec2>& points, const meshing::PlanTriangulation& plan) {
    double area = 0.0;
    for (const glm::uvec3& t : plan.triangles)
        area += 0.5 * turn(points[t.x], points[t.y], points[t.z]);
    return area;
}

std::vector<glm::dvec2> scattered(std::size_t n, std::uint64_t seed) {
    Rng rng({.seed = seed});
    std::vector<glm::dvec2> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    while (points.size() < n)
        points.emplace_back(rng.uniform(), rng.uniform());
    return points;
}

TEST(Delaunay, NoCircleHoldsAnotherPoint) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const auto points = scattered(150, seed);
        const auto plan = triangulate_plan(points);
        EXPECT_EQ(plan.n_repeated, 0U);
        for (const glm::uvec3& t : plan.triangles) {
            const glm::dvec2 a = points[t.x], b = points[t.y] - a, c = points[t.z] - a;
            const double d = 2.0 * (b.x * c.y - b.y * c.x);
            ASSERT_GT(d, 0.0);
            const double bb = b.x * b.x + b.y * b.y, cc = c.x * c.x + c.y * c.y;
            const glm::dvec2 centre((c.y * bb - b.y * cc) / d, (b.x * cc - c.x * bb) / d);
            const double radius = std::hypot(centre.x, centre.y);
            for (const glm::dvec2& p : points)
                EXPECT_GT(std::hypot(p.x - a.x - centre.x, p.y - a.y - centre.y),
                          radius * (1.0 - 1e-4) - 1e-6);
        }
    }
}

TEST(Delaunay, CoversTheHullWithTheTrianglesOfEuler) {
    const auto points = scattered(2000, 7);
    const auto plan = triangulate_plan(points);
    EXPECT_LE(area_of(points, plan), 1.0 + 1e-6);
    EXPECT_GE(area_of(points, plan), 1.0 - 2.0 / 256.0);
    // The square's corners are the hull: 2 n - 2 - 4 triangles, some thin ones along it missing.
    EXPECT_LE(plan.triangles.size(), 2 * points.size() - 6);
    EXPECT_GE(plan.triangles.size(), 2 * points.size() - 6 - 40);
}

TEST(Delaunay, TakesGridsWhereCirclesHoldFourPoints) {
    std::vector<glm::dvec2> points;
    for (int y = 0; y < 33; ++y)
        for (int x = 0; x < 65; ++x)
            points.emplace_back(0.25 * x, 0.25 * y);
    const auto plan = triangulate_plan(points);
    EXPECT_EQ(plan.triangles.size(), 2U * 64U * 32U);
    EXPECT_NEAR(area_of(points, plan), 16.0 * 8.0, 1e-9);
    for (const glm::uvec3& t : plan.triangles)
        EXPECT_NEAR(turn(points[t.x], points[t.y], points[t.z]), 0.0625, 1e-12);
}

TEST(Delaunay, TakesCrossingLinesWithoutFlippingForever) {
    // In the order of the curve alone every point of the second line would flip those of the first.
    std::vector<glm::dvec2> points;
    constexpr int kSide = 20'000;
    for (int i = 0; i <= kSide; ++i) {
        points.emplace_back(i, i);
        points.emplace_back(i, kSide - i + 0.5);
    }
    const auto plan = triangulate_plan(points);
    EXPECT_GT(plan.triangles.size(), points.size());
    EXPECT_NEAR(area_of(points, plan), 1.0 * kSide * kSide, 0.01 * kSide * kSide);
}

TEST(Delaunay, LeavesRepeatedPointsOut) {
    std::vector<glm::dvec2> points = scattered(50, 1);
    const std::size_t n = triangulate_plan(points).triangles.size();
    points.insert(points.end(), points.begin(), points.begin() + 20);
    const auto plan = triangulate_plan(points);
    EXPECT_EQ(plan.n_repeated, 20U);
    EXPECT_EQ(plan.triangles.size(), n);
}

TEST(Delaunay, GivesNothingForPointsOnALine) {
    EXPECT_TRUE(triangulate_plan({}).triangles.empty());
    const std::vector<glm::dvec2> same(7, {3.0, 4.0});
    EXPECT_TRUE(triangulate_plan(same).triangles.empty());
    EXPECT_EQ(triangulate_plan(same).n_repeated, 6U);
    std::vector<glm::dvec2> line;
    for (int i = 0; i < 40; ++i)
        line.emplace_back(1e6 + i, 5e6 + i);
    EXPECT_TRUE(triangulate_plan(line).triangles.empty());
}

TEST(Delaunay, TakesPointsFarFromTheOrigin) {
    auto points = scattered(500, 9);
    for (glm::dvec2& p : points)
        p += glm::dvec2(612345.0, 5512345.0);
    const auto plan = triangulate_plan(points);
    EXPECT_NEAR(area_of(points, plan), 1.0, 2.0 / 256.0);
}

TEST(Delaunay, RefusesPlacesThatAreNone) {
    const std::vector<glm::dvec2> bad = {{0, 0}, {1, std::nan("")}};
    EXPECT_THAT([&] { triangulate_plan(bad); },
                ThrowsMessage<InvalidInput>(HasSubstr("a place that is no number")));
    const std::vector<glm::dvec2> far = {{-1e308, 0}, {1e308, 0}};
    EXPECT_THAT([&] { triangulate_plan(far); },
                ThrowsMessage<InvalidInput>(HasSubstr("too far apart")));
}

}  // namespace
}  // namespace scree
