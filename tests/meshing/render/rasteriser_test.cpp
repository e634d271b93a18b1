#include "meshing/render/rasteriser.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"

#include <limits>
#include <vector>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

struct Soup {
    std::vector<glm::vec3> screen;
    std::vector<glm::uvec3> triangles;
};

// Corners on sixteenths, so that exact arithmetic can be repeated in doubles.
Soup random_soup(std::size_t n, int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed});
    Soup soup;
    const auto coordinate = [&](int size) {
        return static_cast<float>(rng.below(static_cast<std::uint64_t>(size + 40) * 16)) / 16.0F -
               20.0F;
    };
    for (std::uint32_t i = 0; i < 3 * n; ++i)
        soup.screen.emplace_back(coordinate(width), coordinate(height), rng.uniform());
    for (std::uint32_t i = 0; i < n; ++i)
        soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    return soup;
}

double edge(const glm::vec3& a, const glm::vec3& b, double x, double y) {
    return (static_cast<double>(b.x) - a.x) * (y - a.y) -
           (static_cast<double>(b.y) - a.y) * (x - a.x);
}

// Nearest triangle at a pixel's centre by asking every one.
std::uint32_t nearest(const Soup& soup, double x, double y, double& best) {
    std::uint32_t found = kNoTriangle;
    best = std::numeric_limits<float>::lowest();
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
        const glm::vec3& a = soup.screen[3 * i];
        const glm::vec3& b = soup.screen[3 * i + 1];
        const glm::vec3& c = soup.screen[3 * i + 2];
        const double u = edge(c, b, x, y);
        const double v = edge(a, c, x, y);
        const double w = edge(b, a, x, y);
        if (u + v + w <= 0 || u < 0 || v < 0 || w < 0)
            continue;
        const double here = (u * a.z + v * b.z + w * c.z) / (u + v + w);
        if (here > best) {
            best = here;
            found = i;
        }
    }
    return found;
}

class Rasterise : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(Rasterise, FindsTheNearestTriangleAsBruteForceDoes) {
    const Soup soup = random_soup(60, 150, 90, GetParam());
    const Visibility seen = rasterise(soup.screen, soup.triangles, 150, 90);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 150; ++x) {
            double best = 0.0;
            const std::uint32_t truth = nearest(soup, x + 0.5, y + 0.5, best);
            if (truth != kNoTriangle) {
                ASSERT_NEAR(seen.nearness(x, y), best, 1e-6) << x << ", " << y;
            } else {
                ASSERT_EQ(seen.triangle(x, y), kNoTriangle) << x << ", " << y;
            }
        }
}

TEST_P(Rasterise, GivesTheSamePictureForAnyThreadCount) {
    const Soup soup = random_soup(1500, 300, 200, GetParam());
    const Visibility parallel = rasterise(soup.screen, soup.triangles, 300, 200);
    const ThreadLimit one(1);
    const Visibility serial = rasterise(soup.screen, soup.triangles, 300, 200);
    EXPECT_EQ(parallel.triangle, serial.triangle);
    EXPECT_EQ(parallel.nearness, serial.nearness);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Rasterise, testing::Range(0U, 4U));

TEST(Rasterise, LeavesNoGapBetweenNeighbours) {
    constexpr std::uint32_t kSide = 30;
    Rng rng({.seed = 3});
    std::vector<glm::vec3> screen;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t y = 0; y <= kSide; ++y)
        for (std::uint32_t x = 0; x <= kSide; ++x)
            screen.emplace_back(7.3 * x + rng.uniform(-2, 2) - 5, 7.3 * y + rng.uniform(-2, 2) - 5,
                                rng.uniform());
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const std::uint32_t a = y * (kSide + 1) + x;
            triangles.emplace_back(a, a + kSide + 1, a + kSide + 2);
            triangles.emplace_back(a, a + kSide + 2, a + 1);
        }
    const Visibility seen = rasterise(screen, triangles, 200, 200);
    for (const std::uint32_t triangle : seen.triangle)
        ASSERT_NE(triangle, kNoTriangle);
}

TEST(Rasterise, LeavesOutWhatCannotBeDrawn) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec3> screen = {{1, 1, 0},   {1, 9, 0},    {9, 9, 0},
                                           {nan, 1, 0}, {1e9F, 1, 0}, {1, 1, nan}};
    const std::vector<glm::uvec3> triangles = {
        {2, 1, 0}, {0, 1, 1}, {3, 1, 2}, {4, 1, 2}, {5, 1, 2}};
    for (const std::uint32_t triangle : rasterise(screen, triangles, 10, 10).triangle)
        EXPECT_EQ(triangle, kNoTriangle);
    EXPECT_NE(rasterise(screen, std::vector<glm::uvec3>{{0, 1, 2}}, 10, 10).triangle(3, 6),
              kNoTriangle);
}

TEST(RasteriseErrors, NameTheSize) {
    EXPECT_THAT([] { rasterise({}, {}, 0, 10); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("0 x 10")));
    EXPECT_THROW(rasterise({}, {}, 10, 16385), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
