#include "meshing/mesh/normals.h"

#include "base/error.h"
#include "tests/support/mesh_shapes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::NormalWeight;

TEST(Normals, PointOutOfASphere) {
    const meshing::TriMesh mesh = test::icosphere(3, 5.0F);
    const auto adjacency = meshing::build_adjacency(mesh);
    for (const auto weight : {NormalWeight::Sphere, NormalWeight::Area, NormalWeight::Angle}) {
        const double tolerance = weight == NormalWeight::Sphere ? 1e-6 : 2e-2;
        const auto normals = meshing::vertex_normals(mesh, adjacency, weight);
        for (std::size_t v = 0; v < normals.size(); ++v)
            EXPECT_LT(glm::distance(normals[v], mesh.positions[v] / 5.0F), tolerance);
    }
}

TEST(Normals, AreExactOnASphereWhateverTheTriangles) {
    meshing::TriMesh mesh = test::icosphere(2);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)  // uneven, yet on the sphere
        mesh.positions[i] = glm::normalize(
            mesh.positions[i] + 0.08F * glm::vec3(std::sin(3.0F * static_cast<float>(i)),
                                                  std::cos(5.0F * static_cast<float>(i)), 0.3F));
    const auto normals = meshing::vertex_normals(mesh, meshing::build_adjacency(mesh));
    for (std::size_t v = 0; v < normals.size(); ++v)
        EXPECT_LT(glm::distance(normals[v], mesh.positions[v]), 1e-5F);
}

TEST(Normals, WeighByTheAngleAtACubesCorner) {
    const meshing::TriMesh mesh = test::cube(1);  // a corner has one or two triangles a side
    const auto normals =
        meshing::vertex_normals(mesh, meshing::build_adjacency(mesh), NormalWeight::Angle);
    for (std::size_t v = 0; v < normals.size(); ++v)
        EXPECT_LT(glm::distance(normals[v], glm::normalize(mesh.positions[v])), 1e-6F);
}

TEST(Normals, AreZeroWithoutAnArea) {
    meshing::TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 2}};
    for (const glm::vec3& n : meshing::vertex_normals(mesh, meshing::build_adjacency(mesh)))
        EXPECT_EQ(n, glm::vec3(0.0F));
}

TEST(Normals, RefuseAnotherMeshsAdjacency) {
    const auto adjacency = meshing::build_adjacency(test::icosphere(1));
    EXPECT_THROW(meshing::vertex_normals(test::icosphere(0), adjacency), InvalidInput);
}

}  // namespace
}  // namespace scree
