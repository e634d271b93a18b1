#include "meshing/curvature/umbrella.h"

#include "base/error.h"
#include "tests/support/mesh_shapes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(Umbrella, IsZeroInsideARegularSheet) {
    const meshing::TriMesh mesh = test::sheet(6, 0.5F);
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto vectors = meshing::umbrella_vectors(mesh, adjacency);
    for (std::size_t v = 0; v < vectors.size(); ++v)
        if (adjacency.rim[v] == 0) {
            EXPECT_LT(glm::length(vectors[v]), 1e-7F);
        }
    EXPECT_GT(glm::length(vectors[0]), 0.1F);  // a rim's points inwards
}

TEST(Umbrella, PointsToTheMeanOfTheNeighbours) {
    meshing::TriMesh mesh;
    mesh.positions = {{0, 2, 0}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
    const auto vectors = meshing::umbrella_vectors(mesh, meshing::build_adjacency(mesh));
    EXPECT_LT(glm::distance(vectors[0], glm::vec3(0, -2, 0)), 1e-7F);
    EXPECT_EQ(vectors[5], glm::vec3(0.0F));
}

TEST(Umbrella, SplitsIntoPartsThatAddUp) {
    const glm::vec3 n = glm::normalize(glm::vec3(1, 2, 3));
    const glm::vec3 vector(0.3F, -0.7F, 0.2F);
    const auto parts = meshing::split_at_normal(vector, n);
    EXPECT_LT(glm::distance(parts.normal + parts.tangential, vector), 1e-7F);
    EXPECT_NEAR(glm::dot(parts.tangential, n), 0.0F, 1e-7F);
}

TEST(Umbrella, RefusesAnotherMeshsAdjacency) {
    const auto adjacency = meshing::build_adjacency(test::icosphere(1));
    EXPECT_THROW(meshing::umbrella_vectors(test::icosphere(0), adjacency), InvalidInput);
}

}  // namespace
}  // namespace scree
