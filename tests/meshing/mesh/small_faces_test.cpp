#include "meshing/mesh/small_faces.h"

#include "base/error.h"
#include "meshing/mesh/topology.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::Adjacency;
using meshing::TriMesh;

double shortest_edge(const TriMesh& mesh) {
    double least = 1e30;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            least = std::min(least, static_cast<double>(glm::distance(
                                        mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]])));
    return least;
}

class UnevenMesh : public testing::TestWithParam<unsigned> {};

TEST_P(UnevenMesh, KeepsItsTopologyAndLosesShortEdges) {
    TriMesh mesh = test::ellipsoid(test::random_sphere_points(1500, GetParam()), {1, 0.8, 0.6});
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const double limit = 0.4 * meshing::mean_edge_length(mesh, adjacency);
    const double volume = meshing::signed_volume(mesh);
    ASSERT_LT(shortest_edge(mesh), limit);

    const auto report = meshing::remove_small_faces(mesh, adjacency, limit);

    EXPECT_GT(report.n_collapsed, 20U);
    const auto topology = meshing::analyse_topology(mesh);
    EXPECT_TRUE(topology.closed && topology.manifold);
    EXPECT_EQ(topology.genus, 0);
    EXPECT_EQ(topology.n_pieces, 1U);
    EXPECT_NEAR(meshing::signed_volume(mesh), volume, 0.02 * volume);
    if (report.n_blocked == 0) {
        EXPECT_GE(shortest_edge(mesh), limit);
    }
    EXPECT_LT(report.n_blocked, 6U);
    // The adjacency that came back is the mesh's own.
    const Adjacency again = meshing::build_adjacency(mesh);
    EXPECT_EQ(adjacency.neighbours, again.neighbours);
    EXPECT_EQ(adjacency.corners, again.corners);
    EXPECT_EQ(report.kept_triangles.size(), mesh.triangles.size());
    EXPECT_EQ(report.kept_vertices.size(), mesh.positions.size());
    EXPECT_TRUE(std::is_sorted(report.kept_triangles.begin(), report.kept_triangles.end()));
}
INSTANTIATE_TEST_SUITE_P(Seeds, UnevenMesh, testing::Range(0U, 5U));

TEST(SmallFaces, LeaveAnEvenMeshAlone) {
    TriMesh mesh = test::icosphere(2);
    const TriMesh before = mesh;
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const auto report = meshing::remove_small_faces(
        mesh, adjacency, 0.1 * meshing::mean_edge_length(mesh, adjacency));
    EXPECT_FALSE(report.changed);
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(SmallFaces, CollapseToTheMiddle) {
    TriMesh mesh = test::sheet(6);
    mesh.positions[24].x = 3.9F;  // its neighbour 25 is at x = 4
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const auto report = meshing::remove_small_faces(mesh, adjacency, 0.2);
    EXPECT_EQ(report.n_collapsed, 1U);
    EXPECT_EQ(mesh.positions.size(), 48U);
    EXPECT_NEAR(mesh.positions[24].x, 3.95F, 1e-6F);
}

TEST(SmallFaces, KeepTheRimWhereItIs) {
    TriMesh mesh = test::sheet(4);
    mesh.positions[6] = {1, 0, 0.05F};  // close to vertex 1 on the rim
    Adjacency adjacency = meshing::build_adjacency(mesh);
    meshing::remove_small_faces(mesh, adjacency, 0.2);
    EXPECT_EQ(mesh.positions.size(), 24U);
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST(SmallFaces, DoNotCloseAHandle) {
    TriMesh mesh = test::torus(1.0, 0.3, 24, 3);  // rings of three short edges
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const auto report = meshing::remove_small_faces(mesh, adjacency, 0.6);
    const auto topology = meshing::analyse_topology(mesh);
    EXPECT_TRUE(topology.closed && topology.manifold);
    EXPECT_EQ(topology.genus, 1);
    EXPECT_GT(report.n_blocked, 0U);
}

TEST(SmallFaces, DropATinyTetrahedron) {
    TriMesh mesh = test::icosphere(1);
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p :
         {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
        mesh.positions.push_back(glm::vec3(5, 5, 5) + 0.001F * p);
    for (const glm::uvec3& t :
         {glm::uvec3(0, 2, 1), glm::uvec3(0, 1, 3), glm::uvec3(0, 3, 2), glm::uvec3(1, 2, 3)})
        mesh.triangles.push_back(t + n);
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const auto report = meshing::remove_small_faces(mesh, adjacency, 0.05);
    EXPECT_EQ(report.n_vanished, 1U);
    EXPECT_EQ(mesh.positions.size(), n);
    EXPECT_EQ(meshing::analyse_topology(mesh).n_pieces, 1U);
}

TEST(SmallFaces, TurnTheLongEdgeOfASliver) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {1, 0, 0.0005F}, {1, 0, -1}};
    mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 4}};
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const auto report = meshing::remove_small_faces(mesh, adjacency, 0.1);
    EXPECT_EQ(report.n_flipped, 1U);
    EXPECT_EQ(mesh.triangles.size(), 4U);
    const auto topology = meshing::analyse_topology(mesh);
    EXPECT_TRUE(topology.manifold);
    EXPECT_NEAR(meshing::surface_area(mesh), 2.0, 1e-6);
}

TEST(SmallFaces, StayAsTheyAreWhereTheMeshIsNoManifold) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {0.01F, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    const TriMesh before = mesh;
    Adjacency adjacency = meshing::build_adjacency(mesh);
    const auto report = meshing::remove_small_faces(mesh, adjacency, 0.1);
    EXPECT_EQ(report.n_blocked, 1U);
    EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(SmallFacesErrors, NameTheSizes) {
    Adjacency adjacency = meshing::build_adjacency(test::icosphere(1));
    TriMesh mesh = test::icosphere(0);
    EXPECT_THROW(meshing::remove_small_faces(mesh, adjacency, 0.1), InvalidInput);
}

}  // namespace
}  // namespace scree
