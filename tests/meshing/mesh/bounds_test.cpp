#include "meshing/mesh/bounds.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

TriMesh cube(float half) {
    TriMesh mesh;
    for (unsigned k = 0; k < 8; ++k)
        mesh.positions.emplace_back((k & 1U) ? half : -half, (k & 2U) ? half : -half,
                                    (k & 4U) ? half : -half);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TEST(Bounds, CubeHasItsBoxAndSpheres) {
    const TriMesh mesh = cube(2.0F);
    EXPECT_EQ(bounding_box(mesh).min, glm::vec3(-2.0F));
    EXPECT_EQ(bounding_box(mesh).max, glm::vec3(2.0F));
    EXPECT_NEAR(outer_radius(mesh), 2.0 * std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(inner_radius(mesh), 2.0, 1e-6);
    EXPECT_LE(inner_radius(mesh), 2.0F);
    EXPECT_GE(outer_radius(mesh), 2.0F * std::sqrt(3.0F));
}

// The nearest point of a triangle by trying a fine grid of its points.
double nearest_by_search(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    double best = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 200;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
            const glm::dvec3 p =
                a + (b - a) * (i / double{kSteps}) + (c - a) * (j / double{kSteps});
            best = std::min(best, std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z));
        }
    return best;
}

TEST(Bounds, InnerRadiusIsTheDistanceToTheNearestPoint) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Rng rng({.seed = seed, .stream = 1});
        TriMesh mesh;
        for (int k = 0; k < 3; ++k)
            mesh.positions.emplace_back(rng.uniform(-1, 1), rng.uniform(-1, 1),
                                        rng.uniform(-1, 1) + 0.5);
        mesh.triangles = {{0, 1, 2}};
        const double wanted =
            nearest_by_search(glm::dvec3(mesh.positions[0]), glm::dvec3(mesh.positions[1]),
                              glm::dvec3(mesh.positions[2]));
        EXPECT_NEAR(inner_radius(mesh), wanted, 0.02) << "seed " << seed;
        EXPECT_LE(inner_radius(mesh), wanted + 1e-7) << "seed " << seed;
    }
}

TEST(Bounds, EmptyMeshes) {
    EXPECT_THROW(bounding_box({}), InvalidInput);
    EXPECT_EQ(outer_radius({}), 0.0F);
    EXPECT_EQ(inner_radius({}), 0.0F);
}

}  // namespace
}  // namespace scree::meshing
