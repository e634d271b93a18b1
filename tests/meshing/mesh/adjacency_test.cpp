#include "meshing/mesh/adjacency.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/support/mesh_shapes.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::Adjacency;
using meshing::build_adjacency;
using meshing::TriMesh;

// What the lists must hold, from a plain look at all triangles.
void expect_same_sets(const TriMesh& mesh, const Adjacency& adjacency) {
    std::vector<std::set<std::uint32_t>> neighbours(mesh.positions.size());
    std::vector<std::set<std::uint32_t>> corners(mesh.positions.size());
    for (std::uint32_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
        const glm::uvec3 t = meshing::vertices_from(mesh, c);
        neighbours[t.x].insert({t.y, t.z});
        corners[t.x].insert(c);
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto ring = adjacency.neighbours_of(v);
        const auto fan = adjacency.corners_of(v);
        EXPECT_EQ(std::set(ring.begin(), ring.end()), neighbours[v]) << "vertex " << v;
        EXPECT_EQ(ring.size(), neighbours[v].size()) << "vertex " << v;
        EXPECT_EQ(std::set(fan.begin(), fan.end()), corners[v]) << "vertex " << v;
        EXPECT_EQ(fan.size(), corners[v].size()) << "vertex " << v;
    }
}

void expect_fans_in_order(const TriMesh& mesh, const Adjacency& adjacency) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ASSERT_EQ(adjacency.irregular[v], 0) << "vertex " << v;
        const auto ring = adjacency.neighbours_of(v);
        const auto fan = adjacency.corners_of(v);
        ASSERT_EQ(ring.size(), fan.size() + adjacency.rim[v]) << "vertex " << v;
        for (std::size_t j = 0; j < fan.size(); ++j)
            EXPECT_EQ(meshing::vertices_from(mesh, fan[j]),
                      glm::uvec3(v, ring[j], ring[(j + 1) % ring.size()]));
    }
}

TEST(Adjacency, OrdersClosedFans) {
    for (const TriMesh& mesh : {test::icosphere(2), test::torus(2, 0.7, 12, 7), test::cube(3)}) {
        const Adjacency adjacency = build_adjacency(mesh);
        expect_same_sets(mesh, adjacency);
        expect_fans_in_order(mesh, adjacency);
        EXPECT_EQ(std::count(adjacency.rim.begin(), adjacency.rim.end(), 1), 0);
        EXPECT_EQ(adjacency.n_edges(), mesh.triangles.size() * 3 / 2);
    }
}

TEST(Adjacency, FindsTheRimOfASheet) {
    const TriMesh mesh = test::sheet(5);
    const Adjacency adjacency = build_adjacency(mesh);
    expect_same_sets(mesh, adjacency);
    expect_fans_in_order(mesh, adjacency);
    EXPECT_EQ(std::count(adjacency.rim.begin(), adjacency.rim.end(), 1), 20);
    EXPECT_EQ(adjacency.rim[0], 1);
    EXPECT_EQ(adjacency.rim[7], 0);
}

TEST(Adjacency, MarksWhatIsNoManifold) {
    TriMesh mesh;
    mesh.positions.resize(9);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5},   // two fans at 0
                      {6, 7, 8}, {7, 6, 1}, {6, 7, 2}};  // three triangles at 6-7
    const Adjacency adjacency = build_adjacency(mesh);
    expect_same_sets(mesh, adjacency);
    EXPECT_EQ(adjacency.irregular[0], 1);
    EXPECT_EQ(adjacency.irregular[6], 1);
    EXPECT_EQ(adjacency.irregular[3], 0);
    EXPECT_EQ(adjacency.rim[0], 1);
    EXPECT_EQ(adjacency.rim[7], 1);
}

class RandomAdjacency : public testing::TestWithParam<unsigned> {};

TEST_P(RandomAdjacency, HoldsTheSetsOfAnySoup) {
    Rng rng({.seed = GetParam()});
    const auto n = 3 + static_cast<std::uint32_t>(rng.uniform() * 60);
    TriMesh mesh;
    mesh.positions.resize(n);
    for (int i = 0; i < 300; ++i) {
        const auto pick = [&] { return static_cast<std::uint32_t>(rng.uniform() * n) % n; };
        const glm::uvec3 t(pick(), pick(), pick());
        if (t.x != t.y && t.y != t.z && t.z != t.x)
            mesh.triangles.push_back(t);
    }
    expect_same_sets(mesh, build_adjacency(mesh));
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomAdjacency, testing::Range(0U, 8U));

TEST(Adjacency, OrdersALargeFanInTime) {
    constexpr std::uint32_t kSpokes = 200'000;
    TriMesh mesh;
    mesh.positions.resize(kSpokes + 1);
    for (std::uint32_t i = 0; i < kSpokes; ++i)  // dealt out of order
        mesh.triangles.emplace_back(0, 1 + i * 7919ULL % kSpokes, 1 + (i * 7919ULL + 1) % kSpokes);
    const Adjacency adjacency = build_adjacency(mesh);
    EXPECT_EQ(adjacency.irregular[0], 0);
    EXPECT_EQ(adjacency.rim[0], 0);
    const auto ring = adjacency.neighbours_of(0);
    ASSERT_EQ(ring.size(), kSpokes);
    for (std::uint32_t i = 1; i < kSpokes; ++i)
        ASSERT_EQ(ring[i] - 1, ring[i - 1] % kSpokes);
}

TEST(Adjacency, FindsTheTriangleAcross) {
    const TriMesh mesh = test::sheet(1);
    const Adjacency adjacency = build_adjacency(mesh);
    EXPECT_EQ(meshing::triangle_across(mesh, adjacency, 1), 1U);  // faces the diagonal
    EXPECT_EQ(meshing::triangle_across(mesh, adjacency, 0), meshing::kNoFace);
}

TEST(Adjacency, MeasuresTheMeanEdge) {
    const TriMesh mesh = test::sheet(1, 2.0F);
    EXPECT_NEAR(meshing::mean_edge_length(mesh, build_adjacency(mesh)),
                (4 * 2.0 + std::sqrt(8.0)) / 5, 1e-6);
}

TEST(Adjacency, IsTheSameForAnyNumberOfThreads) {
    const TriMesh mesh = test::torus(2, 0.5, 200, 80);
    const Adjacency all = build_adjacency(mesh);
    const ThreadLimit one(1);
    const Adjacency single = build_adjacency(mesh);
    EXPECT_EQ(all.corners, single.corners);
    EXPECT_EQ(all.neighbours, single.neighbours);
    EXPECT_EQ(all.first_neighbour, single.first_neighbour);
}

TEST(AdjacencyErrors, NameTheTriangle) {
    TriMesh mesh;
    mesh.positions.resize(3);
    mesh.triangles = {{0, 1, 7}};
    EXPECT_THAT([&] { build_adjacency(mesh); },
                testing::ThrowsMessage<InvalidInput>("triangle 0 names vertex 7, the mesh has 3"));
    mesh.triangles = {{0, 1, 2}, {2, 1, 2}};
    EXPECT_THAT([&] { build_adjacency(mesh); },
                testing::ThrowsMessage<InvalidInput>(
                    "triangle 1 names vertex 2 twice; clean the mesh first"));
}

}  // namespace
}  // namespace scree
