#include "meshing/mesh/cleaning.h"

#include "base/error.h"
#include "base/random.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/topology.h"
#include "tests/support/mesh_shapes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::clean_mesh;
using meshing::TriMesh;

void expect_manifold(const TriMesh& mesh) {
    const auto adjacency = meshing::build_adjacency(mesh);
    EXPECT_EQ(std::count(adjacency.irregular.begin(), adjacency.irregular.end(), 1), 0);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        EXPECT_FALSE(adjacency.corners_of(v).empty());
}

TEST(Cleaning, LeavesAGoodMeshAlone) {
    for (const TriMesh& good : {test::icosphere(2), test::sheet(4), test::torus(2, 0.7, 9, 7)}) {
        TriMesh mesh = good;
        const auto report = clean_mesh(mesh);
        EXPECT_TRUE(report.found_nothing());
        EXPECT_EQ(meshing::clean_text(report), "");
        EXPECT_EQ(mesh.positions, good.positions);
        EXPECT_EQ(mesh.triangles, good.triangles);
    }
}

TEST(Cleaning, DropsWhatIsOfNoUse) {
    TriMesh mesh = test::icosphere(1);
    const std::size_t n = mesh.triangles.size();
    const auto first = mesh.triangles.front();
    mesh.positions.insert(mesh.positions.begin() + 5, glm::vec3(9));
    for (glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            t[k] += t[k] >= 5 ? 1 : 0;
    mesh.triangles.insert(mesh.triangles.begin(),
                          {mesh.triangles[3].y, mesh.triangles[3].x, mesh.triangles[3].z});
    mesh.triangles.emplace_back(1, 2, 2);
    const auto report = clean_mesh(mesh);
    EXPECT_EQ(report.n_duplicate, 1U);
    EXPECT_EQ(report.n_degenerate, 1U);
    EXPECT_EQ(report.n_unused, 1U);
    EXPECT_EQ(report.n_flipped, 1U);  // the repeated one came first, facing inwards
    EXPECT_EQ(meshing::clean_text(report),
              "1 triangle without area dropped, 1 repeated triangle dropped, 1 triangle turned "
              "round, 1 unused vertex dropped");
    EXPECT_EQ(mesh.triangles.size(), n);
    EXPECT_EQ(mesh.triangles[1], first);
    EXPECT_EQ(report.source[4], 4U);
    EXPECT_EQ(report.source[5], 6U);
    EXPECT_EQ(meshing::solid_defect(mesh), "");
}

TEST(Cleaning, TurnsTrianglesTheWayMostFace) {
    TriMesh mesh = test::sheet(4);
    for (const std::size_t i : {3U, 9U, 10U})
        std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
    EXPECT_EQ(clean_mesh(mesh).n_flipped, 3U);
    EXPECT_EQ(mesh.triangles, test::sheet(4).triangles);
}

TEST(Cleaning, TurnsAClosedBodyInsideOut) {
    TriMesh mesh = test::flipped(test::icosphere(1));
    const auto report = clean_mesh(mesh);
    EXPECT_EQ(report.n_flipped, mesh.triangles.size());
    EXPECT_GT(meshing::signed_volume(mesh), 0.0);
}

TEST(Cleaning, CutsEdgesOfThreeTriangles) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    const auto report = clean_mesh(mesh);
    EXPECT_EQ(report.n_cut_edges, 1U);
    EXPECT_EQ(report.n_split, 4U);
    EXPECT_EQ(mesh.positions.size(), 9U);
    expect_manifold(mesh);
}

TEST(Cleaning, PartsBodiesThatTouchAtAVertex) {
    TriMesh mesh = test::icosphere(0);
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    TriMesh other = test::icosphere(0);
    for (const glm::vec3& p : other.positions)
        mesh.positions.push_back(2.0F * mesh.positions[0] - p);
    for (glm::uvec3 t : other.triangles) {
        for (int k = 0; k < 3; ++k)
            t[k] = t[k] == 0 ? 0 : t[k] + n;
        mesh.triangles.emplace_back(t.x, t.z, t.y);
    }
    const auto report = clean_mesh(mesh);
    EXPECT_EQ(report.n_split, 1U);
    EXPECT_EQ(report.n_unused, 1U);
    EXPECT_EQ(report.n_flipped, 0U);
    expect_manifold(mesh);
}

TEST(Cleaning, JoinsPlacesIfTold) {
    TriMesh mesh;
    for (const glm::uvec3& t : test::icosphere(1).triangles)
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(test::icosphere(1).positions[t[k]]);
    for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3)
        mesh.triangles.emplace_back(i, i + 1, i + 2);
    TriMesh apart = mesh;
    EXPECT_EQ(clean_mesh(apart).n_welded, 0U);
    EXPECT_EQ(apart.positions.size(), mesh.positions.size());
    EXPECT_EQ(clean_mesh(mesh, {.weld = true}).n_welded, 240U - 42U);
    EXPECT_EQ(meshing::solid_defect(mesh), "");
}

TEST(Cleaning, CutsWhatNothingCanOrient) {
    TriMesh mesh;  // a strip with half a turn
    constexpr std::uint32_t n = 9;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float a = 6.2831853F * static_cast<float>(i) / n;
        const glm::vec3 out(std::cos(a), 0, std::sin(a));
        const glm::vec3 arm = 0.3F * (std::cos(a / 2) * out + glm::vec3(0, std::sin(a / 2), 0));
        mesh.positions.push_back(out + arm);
        mesh.positions.push_back(out - arm);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        const std::uint32_t a = 2 * i, b = 2 * i + 1;
        const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : b + 2;
        mesh.triangles.emplace_back(a, b, d);
        mesh.triangles.emplace_back(a, d, c);
    }
    EXPECT_GT(clean_mesh(mesh).n_cut_edges, 0U);
    expect_manifold(mesh);
}

class AnySoup : public testing::TestWithParam<unsigned> {};

TEST_P(AnySoup, BecomesAManifoldThatStaysOne) {
    Rng rng({.seed = GetParam()});
    TriMesh mesh;
    for (int i = 0; i < 20; ++i)
        mesh.positions.emplace_back(rng.uniform(), rng.uniform(), rng.uniform());
    for (int i = 0; i < 90; ++i)
        mesh.triangles.emplace_back(rng.below(20), rng.below(20), rng.below(20));
    clean_mesh(mesh);
    expect_manifold(mesh);
    EXPECT_TRUE(clean_mesh(mesh).found_nothing());
}
INSTANTIATE_TEST_SUITE_P(Seeds, AnySoup, testing::Range(0U, 8U));

TEST(CleaningErrors, RefuseABrokenMesh) {
    TriMesh mesh = test::icosphere(0);
    mesh.triangles[0].x = 99;
    EXPECT_THROW(clean_mesh(mesh), InvalidInput);
}

}  // namespace
}  // namespace scree
