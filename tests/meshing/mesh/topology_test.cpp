#include "meshing/mesh/topology.h"

#include "base/error.h"
#include "meshing/mesh/weld.h"
#include "tests/support/mesh_checks.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

TriMesh tetrahedron() {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

TriMesh torus(unsigned n, unsigned m) {
    TriMesh mesh;
    for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < m; ++j) {
            const double u = 2.0 * std::numbers::pi * i / n;
            const double v = 2.0 * std::numbers::pi * j / m;
            const double reach = 2.0 + 0.5 * std::cos(v);
            mesh.positions.emplace_back(reach * std::cos(u), 0.5 * std::sin(v),
                                        reach * std::sin(u));
            const unsigned right = (i + 1) % n;
            const unsigned up = (j + 1) % m;
            mesh.triangles.emplace_back(i * m + j, i * m + up, right * m + up);
            mesh.triangles.emplace_back(i * m + j, right * m + up, right * m + j);
        }
    }
    return mesh;
}

TriMesh joined(TriMesh a, const TriMesh& b, glm::vec3 shift) {
    const auto n = static_cast<unsigned>(a.positions.size());
    for (const glm::vec3& p : b.positions)
        a.positions.push_back(p + shift);
    for (const glm::uvec3& t : b.triangles)
        a.triangles.push_back(t + n);
    return a;
}

TEST(Topology, TetrahedronIsASolid) {
    test::expect_valid(tetrahedron());
    const TopologyReport report = analyse_topology(tetrahedron());
    EXPECT_EQ(report.n_vertices, 4U);
    EXPECT_EQ(report.n_edges, 6U);
    EXPECT_EQ(report.n_triangles, 4U);
}

TEST(Topology, TorusHasOneHandleAndTwoToriHaveTwo) {
    EXPECT_EQ(analyse_topology(torus(12, 7)).genus, 1);
    EXPECT_EQ(solid_defect(torus(12, 7)), "");
    const TopologyReport two = analyse_topology(joined(torus(5, 4), torus(6, 3), {9, 0, 0}));
    EXPECT_EQ(two.genus, 2);
    EXPECT_EQ(two.n_pieces, 2U);
}

TEST(Topology, SeparateTrianglesAreWelded) {
    TriMesh soup;
    const TriMesh solid = tetrahedron();
    for (const glm::uvec3& t : solid.triangles) {
        const auto n = static_cast<unsigned>(soup.positions.size());
        for (int k = 0; k < 3; ++k)
            soup.positions.push_back(solid.positions[t[k]]);
        soup.triangles.emplace_back(n, n + 1, n + 2);
    }
    test::expect_valid(soup);
    EXPECT_EQ(weld(soup).positions.size(), 4U);
}

TEST(Topology, NegativeZeroIsZero) {
    TriMesh mesh = tetrahedron();
    mesh.positions.push_back({-0.0F, 0.0F, -0.0F});
    mesh.triangles[0].x = 4;
    test::expect_valid(mesh);
}

TEST(Topology, NamesTheDefect) {
    TriMesh open = tetrahedron();
    open.triangles.pop_back();
    EXPECT_THAT(solid_defect(open), testing::HasSubstr("not closed"));
    EXPECT_EQ(analyse_topology(open).n_boundaries, 1U);
    EXPECT_TRUE(analyse_topology(open).manifold);

    TriMesh turned = tetrahedron();
    std::swap(turned.triangles[0].x, turned.triangles[0].y);
    EXPECT_THAT(solid_defect(turned), testing::HasSubstr("disagree"));

    TriMesh inside_out = tetrahedron();
    for (glm::uvec3& t : inside_out.triangles)
        std::swap(t.x, t.y);
    EXPECT_THAT(solid_defect(inside_out), testing::HasSubstr("no positive volume"));

    TriMesh mirrored = tetrahedron();
    for (glm::vec3& p : mirrored.positions)
        p = -p;
    for (glm::uvec3& t : mirrored.triangles)
        std::swap(t.x, t.y);
    const TriMesh touching = joined(tetrahedron(), mirrored, {0, 0, 0});
    EXPECT_THAT(solid_defect(touching), testing::HasSubstr("touches itself"));
    EXPECT_EQ(analyse_topology(touching).n_pieces, 2U);

    TriMesh thin = tetrahedron();
    thin.positions.push_back({0.5F, 0, 0});
    thin.triangles[1] = {4, 1, 3};
    thin.triangles.push_back({0, 4, 3});
    thin.triangles.push_back({0, 1, 4});
    EXPECT_THAT(solid_defect(thin), testing::HasSubstr("no area"));

    TriMesh collapsed = tetrahedron();
    collapsed.triangles.push_back({1, 1, 2});
    EXPECT_THAT(solid_defect(collapsed), testing::HasSubstr("one place twice"));

    EXPECT_THAT(solid_defect(TriMesh{}), testing::HasSubstr("no triangle"));
}

TEST(Topology, ThreeTrianglesAtAnEdgeAreNoSurface) {
    TriMesh book;
    book.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}};
    book.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const TopologyReport report = analyse_topology(book);
    EXPECT_FALSE(report.manifold);
    EXPECT_FALSE(report.oriented);
    EXPECT_FALSE(report.closed);
}

TEST(Topology, RefusesABadIndex) {
    TriMesh mesh = tetrahedron();
    mesh.triangles[0].x = 7;
    EXPECT_THROW(analyse_topology(mesh), InvalidInput);
    EXPECT_THROW(solid_defect(mesh), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
