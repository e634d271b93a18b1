#include "terrain/fluid/triangle_grid.h"

#include "base/error.h"
#include "base/random.h"
#include "tests/support/mesh_shapes.h"
#include "tests/terrain/fluid/fluid_samples.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::TriMesh;
using terrain::SurfaceHit;
using terrain::TriangleGrid;

glm::vec3 random_point(Rng& rng, double reach) {
    return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-reach, reach)};
}

// Distance to a triangle by minimising over a fine sheet of barycentric places and its edges.
double distance_by_sampling(const TriMesh& mesh, const glm::vec3& p) {
    double best = 1e30;
    constexpr int kSteps = 24;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; i + j <= kSteps; ++j) {
                const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps;
                const glm::vec3 q = mesh.positions[t.x] * (1 - u - v) + mesh.positions[t.y] * u +
                                    mesh.positions[t.z] * v;
                best = std::min(best, static_cast<double>(glm::distance(p, q)));
            }
    return best;
}

class Grid : public testing::TestWithParam<unsigned> {};

TEST_P(Grid, FindsTheNearestSurfaceWithTheRightSign) {
    const TriMesh mesh = test::cube(3, 1.0F);
    const TriangleGrid grid(mesh, 0.1F);
    Rng rng({GetParam(), 2, 0, 0});
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 p = random_point(rng, 0.9);
        const SurfaceHit hit = grid.nearest(p, 0.6F);
        const double expected = distance_by_sampling(mesh, p);
        if (!hit.found()) {
            EXPECT_GT(expected, 0.59);
            continue;
        }
        EXPECT_NEAR(std::abs(hit.distance), expected, 0.02);
        EXPECT_LE(std::abs(hit.distance), expected + 1e-4);
        EXPECT_NEAR(glm::distance(hit.point, p), std::abs(hit.distance), 1e-5);
        const bool inside = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 0.5F;
        EXPECT_EQ(hit.distance < 0.0F, inside) << p.x << ' ' << p.y << ' ' << p.z;
        EXPECT_EQ(grid.buried(p), inside);
    }
}

TEST_P(Grid, LetsNothingInThroughFacesEdgesOrCorners) {
    const TriMesh mesh = test::cube(4, 1.0F);
    const TriangleGrid grid(mesh, 0.1F);
    Rng rng({GetParam(), 3, 0, 0});
    const auto check = [&](const glm::vec3& target, const glm::vec3& from) {
        const glm::vec3 to = from + (target - from) * 1.2F;  // ends inside the cube
        const float share = grid.free_share(from, to);
        EXPECT_NEAR(share, 1.0 / 1.2, 1e-4);
        EXPECT_EQ(grid.free_share(to, from), 1.0F);  // the way out is free
    };
    for (int i = 0; i < 200; ++i) {
        const glm::uvec3& t = mesh.triangles[rng.below(mesh.triangles.size())];
        const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y];
        const glm::vec3 c = mesh.positions[t.z];
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const auto s = static_cast<float>(rng.uniform());
        for (const glm::vec3& target : {a, glm::mix(a, b, s), (a + b + c) / 3.0F})
            check(target, target + 0.2F * normal + 0.1F * target);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, Grid, testing::Range(0U, 3U));

TEST(Grid, GivesOnePlaneOnFlatGroundAndTwoInACorner) {
    const TriMesh flat = test::level_ground(1.0F, 10);
    const TriangleGrid ground(flat, 0.1F);
    for (const float height : {0.001F, 0.05F, -0.03F}) {
        const auto planes = ground.contacts({0.013F, height, 0.027F}, 0.3F);
        ASSERT_EQ(planes.count, 1) << height;
        EXPECT_NEAR(planes.planes[0].normal.y, 1.0F, 1e-5F);
    }
    const TriangleGrid tub(test::tub({1, 1, 1}, 5), 0.1F);
    EXPECT_EQ(tub.contacts({0.05F, 0.06F, 0.5F}, 0.2F).count, 2);
    EXPECT_EQ(tub.contacts({0.05F, 0.06F, 0.07F}, 0.2F).count, 3);
    EXPECT_EQ(tub.contacts({0.5F, 0.5F, 0.5F}, 0.2F).count, 0);
}

TEST(Grid, BelowAnOpenSheetIsBuried) {
    const TriangleGrid ground(test::level_ground(1.0F, 4), 0.1F);
    EXPECT_TRUE(ground.buried({0.1F, -0.5F, 0.2F}));
    EXPECT_FALSE(ground.buried({0.1F, 0.5F, 0.2F}));
    EXPECT_FALSE(ground.buried({5.0F, -0.5F, 0.0F}));
    EXPECT_FALSE(TriangleGrid(test::tub({1, 1, 1}, 3), 0.1F).buried({0.5F, 0.5F, 0.5F}));
}

TEST(Grid, RefusesWhatIsNoSurface) {
    EXPECT_THROW(TriangleGrid(TriMesh{}, 0.1F), InvalidInput);
    TriMesh broken = test::level_ground(1.0F, 1);
    broken.triangles[0].x = 99;
    EXPECT_THROW(TriangleGrid(broken, 0.1F), InvalidInput);
}

TEST(Grid, TakesTrianglesWithoutArea) {
    TriMesh mesh = test::level_ground(1.0F, 2);
    mesh.triangles.emplace_back(0, 0, 1);
    mesh.triangles.emplace_back(0, 1, 2);  // on a line
    const TriangleGrid grid(mesh, 0.1F);
    EXPECT_NEAR(grid.nearest({0.2F, 0.1F, 0.2F}, 0.5F).distance, 0.1F, 1e-6F);
    EXPECT_EQ(grid.contacts({-0.6F, 0.02F, 0.95F}, 0.2F).count, 1);
}

}  // namespace
}  // namespace scree
