#include "meshing/mesh/tri_mesh.h"

#include "base/error.h"

#include <limits>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

TriMesh tetrahedron() {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

TEST(TriMesh, TetrahedronHasItsVolumeAndArea) {
    EXPECT_NEAR(signed_volume(tetrahedron()), 1.0 / 6.0, 1e-12);
    EXPECT_NEAR(surface_area(tetrahedron()), 1.5 + std::sqrt(3.0) / 2.0, 1e-7);
}

TEST(TriMesh, CheckNamesWhatIsWrong) {
    TriMesh mesh = tetrahedron();
    EXPECT_NO_THROW(check_mesh(mesh));
    mesh.triangles.push_back({0, 1, 9});
    EXPECT_THAT([&] { check_mesh(mesh); },
                testing::ThrowsMessage<InvalidInput>("a triangle names vertex 9, the mesh has 4"));
    mesh = tetrahedron();
    mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(check_mesh(mesh), InvalidInput);
    mesh = tetrahedron();
    mesh.normals.resize(2);
    EXPECT_THROW(check_mesh(mesh), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
