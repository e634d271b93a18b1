#include "meshing/mesh/decimation.h"

#include "base/error.h"
#include "meshing/mesh/topology.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/sphere_meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::decimate;
using meshing::TriMesh;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Decimation, ReachesTheTargetOnASheetAndKeepsItFlat) {
    TriMesh mesh = test::sheet(40);
    const auto report = decimate(mesh, {.vertices = 300});
    EXPECT_TRUE(report.reached);
    EXPECT_EQ(mesh.positions.size(), 300U);
    EXPECT_EQ(report.kept_vertices.size(), 300U);
    EXPECT_EQ(report.n_collapsed, 41U * 41U - 300U);
    EXPECT_NEAR(meshing::surface_area(mesh), 1600.0, 1e-3);  // corners and rims stayed
    for (const glm::vec3& p : mesh.positions)
        EXPECT_EQ(p.y, 0.0F);
    const auto topology = meshing::analyse_topology(mesh);
    EXPECT_TRUE(topology.manifold);
    EXPECT_EQ(topology.n_boundaries, 1U);
}

TEST(Decimation, KeepsASphereRoundAndClosed) {
    TriMesh mesh = test::icosphere(4);
    const TriMesh before = mesh;
    const auto report = decimate(mesh, {.vertices = 400});
    EXPECT_EQ(mesh.positions.size(), 400U);
    EXPECT_EQ(meshing::solid_defect(mesh), "");
    EXPECT_NEAR(meshing::signed_volume(mesh) / meshing::signed_volume(before), 1.0, 0.03);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_EQ(mesh.positions[i], before.positions[report.kept_vertices[i]]);
}

// Share of the vertices on the left half of a sheet whose right half is wavy.
double share_on_the_flat(double evenness) {
    TriMesh mesh = test::sheet(40);
    for (glm::vec3& p : mesh.positions)
        p.y = p.x < 20.0F ? 0.0F : std::sin(1.2F * p.x) * std::cos(1.2F * p.z);
    decimate(mesh, {.vertices = 400, .evenness = evenness});
    const auto left = std::count_if(mesh.positions.begin(), mesh.positions.end(),
                                    [](const glm::vec3& p) { return p.x < 20.0F; });
    return static_cast<double>(left) / static_cast<double>(mesh.positions.size());
}

TEST(Decimation, PutsDetailWhereTheShapeBendsUnlessEven) {
    EXPECT_LT(share_on_the_flat(0.001), 0.25);
    EXPECT_GT(share_on_the_flat(1.0), 0.3);
}

TEST(Decimation, KeepsUpWhatLooksUp) {
    TriMesh mesh = test::sheet(30);
    for (glm::vec3& p : mesh.positions)
        p.y = std::abs(p.x - 15.0F) < 2.5F ? -6.0F : 0.0F;  // a ditch with steep walls
    decimate(mesh, {.vertices = 150, .keep_up = true});
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                       mesh.positions[t.z] - mesh.positions[t.x]);
        EXPECT_GT(n.y, 0.0F);
    }
}

TEST(Decimation, SaysWhenItCannotGoOn) {
    TriMesh mesh = test::icosphere(1);
    const auto report = decimate(mesh, {.vertices = 4});
    EXPECT_EQ(report.reached, mesh.positions.size() <= 4);
    EXPECT_EQ(meshing::solid_defect(mesh), "");
    TriMesh few = test::sheet(2);
    EXPECT_TRUE(decimate(few, {.vertices = 100}).reached);
    EXPECT_EQ(few.positions.size(), 9U);
}

TEST(Decimation, RefusesWhatIsNoManifold) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    EXPECT_THAT([&] { decimate(mesh, {.vertices = 4}); },
                ThrowsMessage<InvalidInput>(HasSubstr("clean it first")));
    TriMesh turned = test::sheet(2);
    std::swap(turned.triangles[0].x, turned.triangles[0].y);
    EXPECT_THROW(decimate(turned, {.vertices = 4}), InvalidInput);
    TriMesh empty;
    EXPECT_THROW(decimate(empty, {}), InvalidInput);
    TriMesh sheet = test::sheet(2);
    EXPECT_THROW(decimate(sheet, {.vertices = 1}), InvalidOption);
}

}  // namespace
}  // namespace scree
