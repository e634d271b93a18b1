#include "terrain/fluid/point_cells.h"

#include "base/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scree {
namespace {

using terrain::PointCells;

std::vector<glm::vec3> scatter(std::uint64_t seed, int n, double flatness) {
    Rng rng({seed, 1, 0, 0});
    std::vector<glm::vec3> points;
    for (int i = 0; i < n; ++i)
        points.emplace_back(rng.uniform(-1, 1), flatness * rng.uniform(-1, 1), rng.uniform(-2, 1));
    return points;
}

float nearest_by_hand(const std::vector<glm::vec3>& points, const glm::vec3& at, float reach) {
    float best = std::numeric_limits<float>::infinity();
    for (const glm::vec3& p : points) {
        const glm::vec3 d = p - at;
        if (glm::dot(d, d) < reach * reach)
            best = std::min(best, glm::dot(d, d));
    }
    return best;
}

class Cells : public testing::TestWithParam<unsigned> {};

TEST_P(Cells, FindTheNearestPointAsLookingAtAllDoes) {
    const auto points = scatter(GetParam(), 300, GetParam() % 2 == 0 ? 1.0 : 0.0);
    const auto queries = scatter(GetParam() + 100, 400, 1.3);
    for (const float reach : {0.05F, 0.3F, 5.0F}) {
        const PointCells cells(points, reach);
        for (const glm::vec3& q : queries)
            ASSERT_EQ(cells.nearest_squared(q, reach), nearest_by_hand(points, q, reach));
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, Cells, testing::Range(0U, 4U));

TEST(Cells, HoldEveryPointOnceInTheOrderOfItsCell) {
    const auto points = scatter(7, 500, 1.0);
    const PointCells cells(points, 0.2F);
    std::vector<int> seen(points.size(), 0);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        ++seen[cells.index_of(k)];
        EXPECT_EQ(cells.sorted(k), points[cells.index_of(k)]);
    }
    EXPECT_EQ(seen, std::vector<int>(points.size(), 1));
}

TEST(Cells, TakeNoPointsAndFarOnes) {
    EXPECT_TRUE(std::isinf(PointCells({}, 1.0F).nearest_squared(glm::vec3(0), 1.0F)));
    // A grid of cells of 1 cm over 2000 km would not fit: it becomes coarser instead.
    const std::vector<glm::vec3> far = {glm::vec3(-1e6F), glm::vec3(1e6F), glm::vec3(0.0F)};
    const PointCells cells(far, 0.01F);
    EXPECT_EQ(cells.nearest_squared({0.005F, 0, 0}, 0.01F), 0.005F * 0.005F);
}

}  // namespace
}  // namespace scree
