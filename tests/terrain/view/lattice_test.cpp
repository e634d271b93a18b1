#include "terrain/view/lattice.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

double doubled_area(const Lattice& l, const LatticePatch& p) {  // positive if seen from above
    const glm::dvec2 a(l.positions[p[0]]);
    const glm::dvec2 b = glm::dvec2(l.positions[p[1]]) - a;
    const glm::dvec2 c = glm::dvec2(l.positions[p[2]]) - a;
    return b.y * c.x - b.x * c.y;
}

class LatticeShapes : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(LatticeShapes, CoversTheAreaOnceFacingUp) {
    const auto [columns, depth] = GetParam();
    const Lattice lattice = make_lattice({-1.0, 2.0, 4.0, depth}, columns);
    double sum = 0.0;
    for (const LatticePatch& p : lattice.patches) {
        const double area = doubled_area(lattice, p);
        EXPECT_GT(area, 0.0);
        sum += area / 2.0;
    }
    EXPECT_NEAR(sum, 4.0 * depth, 1e-4 * depth);
}

TEST_P(LatticeShapes, NeighboursAreThoseOfAPlainEdgeTable) {
    const auto [columns, depth] = GetParam();
    const Lattice lattice = make_lattice({0.0, 0.0, 4.0, depth}, columns);
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Edge, std::vector<std::uint32_t>> opposite;
    constexpr int kEnds[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    for (const LatticePatch& p : lattice.patches)
        for (std::size_t e = 0; e < 3; ++e)
            opposite[std::minmax(p[static_cast<std::size_t>(kEnds[e][0])],
                                 p[static_cast<std::size_t>(kEnds[e][1])])]
                .push_back(p[e]);
    constexpr std::size_t kBeyond[3] = {3, 5, 4};
    std::size_t n_borders = 0;
    for (const LatticePatch& p : lattice.patches)
        for (std::size_t e = 0; e < 3; ++e) {
            auto others = opposite[std::minmax(p[static_cast<std::size_t>(kEnds[e][0])],
                                               p[static_cast<std::size_t>(kEnds[e][1])])];
            ASSERT_LE(others.size(), 2U);
            others.erase(std::find(others.begin(), others.end(), p[e]));
            n_borders += others.empty() ? 1 : 0;
            EXPECT_EQ(p[kBeyond[e]], others.empty() ? p[e] : others.front());
        }
    EXPECT_GT(n_borders, 0U);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LatticeShapes,
                         testing::Combine(testing::Values(1, 2, 7, 16),
                                          testing::Values(0.5, 3.0, 9.0)));

TEST(Lattice, TrianglesInsideAreEquilateral) {
    const Lattice lattice = make_lattice({0.0, 0.0, 8.0, 6.0}, 16);
    std::size_t n_inside = 0;
    for (const LatticePatch& p : lattice.patches) {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec2 at = lattice.positions[p[i]];
            inside = inside && at.x > 0.0F && at.x < 8.0F && at.y < 6.0F;
        }
        if (!inside)
            continue;
        ++n_inside;
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(glm::distance(lattice.positions[p[i]], lattice.positions[p[(i + 1) % 3]]),
                        0.5, 1e-6);
    }
    EXPECT_GT(n_inside, 300U);
}

// A sum of waves in random directions, no longer than `wave`.
struct Waves {
    std::vector<glm::dvec3> waves;  // direction and phase
    explicit Waves(unsigned seed) {
        Rng random({.seed = seed});
        for (int i = 0; i < 12; ++i) {
            const double angle = random.uniform(0.0, 6.283185307);
            const double k = random.uniform(6.0, 14.0);
            const double phase = random.uniform(0.0, 6.283185307);
            waves.emplace_back(k * std::cos(angle), k * std::sin(angle), phase);
        }
    }
    double at(const glm::dvec2& p) const {
        double sum = 0.0;
        for (const glm::dvec3& w : waves)
            sum += std::sin(w.x * p.x + w.y * p.y + w.z);
        return sum;
    }
};

// Mean square of the difference between the waves and their interpolation over a triangle.
void add_error(const Waves& waves, const glm::dvec2 (&corner)[3], double& sum, double& weight) {
    const double area = std::abs((corner[1] - corner[0]).x * (corner[2] - corner[0]).y -
                                 (corner[1] - corner[0]).y * (corner[2] - corner[0]).x);
    const double h[3] = {waves.at(corner[0]), waves.at(corner[1]), waves.at(corner[2])};
    constexpr int n = 4;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j + i < n; ++j) {
            const double u = (i + 1.0 / 3.0) / n;
            const double v = (j + 1.0 / 3.0) / n;
            const double w = 1.0 - u - v;
            const double difference = u * h[0] + v * h[1] + w * h[2] -
                                      waves.at(u * corner[0] + v * corner[1] + w * corner[2]);
            sum += area * difference * difference;
            weight += area;
        }
}

TEST(Lattice, HeightsAreCloserThanThoseOfASquareGridOfAsManyCorners) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        const Waves waves(seed);
        const Lattice lattice = make_lattice({0.0, 0.0, 4.0, 4.0}, 40);
        double sum = 0.0;
        double weight = 0.0;
        for (const LatticePatch& p : lattice.patches)
            add_error(waves,
                      {glm::dvec2(lattice.positions[p[0]]), glm::dvec2(lattice.positions[p[1]]),
                       glm::dvec2(lattice.positions[p[2]])},
                      sum, weight);
        // As many squares as leave the grid at least as many corners as the lattice has.
        const int side =
            static_cast<int>(std::ceil(std::sqrt(static_cast<double>(lattice.positions.size()))));
        const double step = 4.0 / (side - 1);
        double square_sum = 0.0;
        double square_weight = 0.0;
        for (int y = 0; y + 1 < side; ++y)
            for (int x = 0; x + 1 < side; ++x) {
                const glm::dvec2 a(x * step, y * step);
                const glm::dvec2 b(a.x + step, a.y);
                const glm::dvec2 c(a.x, a.y + step);
                const glm::dvec2 d(a.x + step, a.y + step);
                add_error(waves, {a, b, c}, square_sum, square_weight);
                add_error(waves, {b, c, d}, square_sum, square_weight);
            }
        EXPECT_LT(sum / weight, square_sum / square_weight) << "seed " << seed;
    }
}

TEST(LatticeErrors, NameTheValue) {
    EXPECT_THAT([] { make_lattice({}, 0); },
                testing::ThrowsMessage<InvalidOption>("columns is 0, must be in [1, 4096]"));
    EXPECT_THROW(make_lattice({0, 0, 0, 1}, 4), InvalidInput);
    EXPECT_THROW(make_lattice({0, 0, 1, 1e6}, 4096), InvalidOption);
}

}  // namespace
}  // namespace scree::terrain
