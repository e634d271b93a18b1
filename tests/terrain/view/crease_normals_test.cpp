#include "terrain/view/crease_normals.h"

#include "base/error.h"
#include "tests/terrain/view/sample_ground.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

TEST(CreaseNormals, BoxKeepsItsEdges) {
    const meshing::TriMesh box = test::box();
    const auto corners = shaded_corners(box);
    ASSERT_EQ(corners.size(), 36U);
    for (const ShadedCorner& corner : corners) {
        const glm::vec3 n = glm::abs(corner.normal);
        EXPECT_NEAR(std::max({n.x, n.y, n.z}), 1.0F, 1e-6F);
        EXPECT_NEAR(glm::dot(corner.normal, corner.position), 0.5F, 1e-6F);
    }
}

TEST(CreaseNormals, SphereBecomesSmooth) {
    meshing::TriMesh ball = test::sphere(32);
    ball.normals.clear();
    for (const ShadedCorner& corner : shaded_corners(ball))
        if (std::abs(corner.position.y) < 0.95F && corner.position.x < 0.99F) {
            EXPECT_GT(glm::dot(corner.normal, corner.position), 0.99F);
        }
}

TEST(CreaseNormals, OwnNormalsAreKept) {
    meshing::TriMesh box = test::box();
    box.normals.assign(box.positions.size(), glm::vec3(0.0F, 0.6F, 0.8F));
    for (const ShadedCorner& corner : shaded_corners(box))
        EXPECT_EQ(corner.normal, glm::vec3(0.0F, 0.6F, 0.8F));
}

TEST(CreaseNormals, RefuseABrokenMesh) {
    meshing::TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 7}};
    EXPECT_THROW(shaded_corners(mesh), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
