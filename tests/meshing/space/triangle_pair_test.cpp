#include "meshing/space/triangle_pair.h"

#include "base/random.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::TrianglePoints;
using meshing::triangles_meet;

const TrianglePoints kFlat = {glm::vec3(0, 0, 0), glm::vec3(4, 0, 0), glm::vec3(0, 4, 0)};

TEST(TrianglePair, MeetsWhatPiercesOrTouches) {
    EXPECT_TRUE(
        triangles_meet(kFlat, {glm::vec3(1, 1, -1), glm::vec3(1, 1, 1), glm::vec3(2, 9, 1)}));
    EXPECT_TRUE(
        triangles_meet(kFlat, {glm::vec3(1, 1, 0), glm::vec3(1, 1, 1), glm::vec3(2, 2, 1)}));
    EXPECT_TRUE(
        triangles_meet(kFlat, {glm::vec3(2, 2, 0), glm::vec3(5, 5, 1), glm::vec3(5, 5, -1)}));
    EXPECT_FALSE(
        triangles_meet(kFlat, {glm::vec3(1, 1, 0.01F), glm::vec3(1, 1, 1), glm::vec3(2, 2, 1)}));
    EXPECT_FALSE(
        triangles_meet(kFlat, {glm::vec3(3, 3, -1), glm::vec3(3, 3, 1), glm::vec3(9, 9, 1)}));
}

TEST(TrianglePair, MeetsInOnePlane) {
    const auto moved = [](float x, float y) {
        TrianglePoints t = kFlat;
        for (glm::vec3& p : t)
            p = 0.25F * p + glm::vec3(x, y, 0);
        return t;
    };
    EXPECT_TRUE(triangles_meet(kFlat, moved(0.5F, 0.5F)));  // inside
    EXPECT_TRUE(triangles_meet(moved(0.5F, 0.5F), kFlat));
    EXPECT_TRUE(triangles_meet(kFlat, moved(-0.5F, 1)));  // across an edge
    EXPECT_TRUE(triangles_meet(kFlat, moved(4, 0)));      // at a corner
    EXPECT_TRUE(triangles_meet(kFlat, moved(2, 2)));      // at an edge
    EXPECT_FALSE(triangles_meet(kFlat, moved(2.1F, 2)));
    EXPECT_FALSE(triangles_meet(kFlat, moved(-1.1F, 1)));
    EXPECT_TRUE(triangles_meet(kFlat, kFlat));
}

TEST(TrianglePair, LeavesOutTrianglesWithoutArea) {
    const TrianglePoints line = {glm::vec3(1, 1, -1), glm::vec3(1, 1, 0), glm::vec3(1, 1, 1)};
    EXPECT_FALSE(triangles_meet(kFlat, line));
    EXPECT_FALSE(triangles_meet(line, kFlat));
    EXPECT_FALSE(triangles_meet(line, line));
}

TEST(TrianglePair, SeesWhatNeighboursDo) {
    const TrianglePoints wing = {glm::vec3(0, 0, 0), glm::vec3(-1, 0, 1), glm::vec3(0, -1, 1)};
    EXPECT_FALSE(meshing::triangles_at_a_vertex_meet(kFlat, wing));
    const TrianglePoints through = {glm::vec3(0, 0, 0), glm::vec3(1, 1, 1), glm::vec3(1, 2, -1)};
    EXPECT_TRUE(meshing::triangles_at_a_vertex_meet(kFlat, through));
    TrianglePoints over = kFlat;
    over[2] = {1, 1, 0};
    EXPECT_TRUE(meshing::triangles_at_an_edge_fold(kFlat, over));
    over[2] = {1, -1, 0};
    EXPECT_FALSE(meshing::triangles_at_an_edge_fold(kFlat, over));
    over[2] = {1, 1, 1e-6F};
    EXPECT_FALSE(meshing::triangles_at_an_edge_fold(kFlat, over));
}

class RandomPairs : public testing::TestWithParam<unsigned> {};

// Samples of one triangle that lie on both sides of the other, next to a point of both, show that
// they meet; a plane between them shows that they do not. Both are sought in a plain way.
TEST_P(RandomPairs, AgreeWithASearchForASeparatingPlane) {
    Rng rng({.seed = GetParam()});
    const auto pick = [&] {
        return glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    };
    int n_meeting = 0;
    for (int i = 0; i < 400; ++i) {
        const TrianglePoints a = {pick(), pick(), pick()};
        const TrianglePoints b = {pick(), pick(), pick()};
        // The separating directions of two triangles: normals and cross products of edges.
        std::vector<glm::dvec3> directions;
        const auto edge = [](const TrianglePoints& t, std::size_t k) {
            return glm::dvec3(t[(k + 1) % 3]) - glm::dvec3(t[k]);
        };
        directions.push_back(glm::cross(edge(a, 0), edge(a, 1)));
        directions.push_back(glm::cross(edge(b, 0), edge(b, 1)));
        for (std::size_t j = 0; j < 9; ++j)
            directions.push_back(glm::cross(edge(a, j / 3), edge(b, j % 3)));
        bool separated = false;
        for (const glm::dvec3& d : directions) {
            double low_a = 1e9, high_a = -1e9, low_b = 1e9, high_b = -1e9;
            for (std::size_t k = 0; k < 3; ++k) {
                low_a = std::min(low_a, glm::dot(d, glm::dvec3(a[k])));
                high_a = std::max(high_a, glm::dot(d, glm::dvec3(a[k])));
                low_b = std::min(low_b, glm::dot(d, glm::dvec3(b[k])));
                high_b = std::max(high_b, glm::dot(d, glm::dvec3(b[k])));
            }
            separated = separated || high_a < low_b || high_b < low_a;
        }
        EXPECT_EQ(triangles_meet(a, b), !separated) << "pair " << i;
        EXPECT_EQ(triangles_meet(b, a), !separated) << "pair " << i;
        n_meeting += separated ? 0 : 1;
    }
    EXPECT_GT(n_meeting, 20);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomPairs, testing::Range(0U, 6U));

}  // namespace
}  // namespace scree
