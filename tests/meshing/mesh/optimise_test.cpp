#include "meshing/mesh/optimise.h"

#include "base/error.h"
#include "meshing/rocks/rock_mesh.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/rock_samples.h"

#include <algorithm>
#include <array>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

using Corner = std::array<float, 8>;  // position, normal and texture coordinate

std::vector<std::array<Corner, 3>> corners_of(const TriMesh& mesh) {
    std::vector<std::array<Corner, 3>> all;
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<Corner, 3> triangle;
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions[t[k]];
            const glm::vec3 n = mesh.normals[t[k]];
            const glm::vec2 c = mesh.texcoords[t[k]];
            triangle[static_cast<std::size_t>(k)] = {p.x, p.y, p.z, n.x, n.y, n.z, c.x, c.y};
        }
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                    triangle.end());
        all.push_back(triangle);
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(Optimise, KeepsTheSurfaceAndDropsUnusedVertices) {
    TriMesh mesh = build_rock_meshes(test::rock_set(1, 4))[0].mesh;
    mesh.positions.insert(mesh.positions.begin(), glm::vec3(9.0F));
    mesh.normals.insert(mesh.normals.begin(), glm::vec3(0.0F));
    mesh.texcoords.insert(mesh.texcoords.begin(), glm::vec2(0.0F));
    for (glm::uvec3& t : mesh.triangles)
        t += 1U;
    const auto before = corners_of(mesh);
    const std::size_t n = mesh.positions.size();
    optimise_for_gpu(mesh);
    EXPECT_EQ(corners_of(mesh), before);
    EXPECT_EQ(mesh.positions.size(), n - 1);
    test::expect_valid(mesh);
    const glm::uvec3 first = mesh.triangles[0];
    EXPECT_EQ(first, glm::uvec3(0, 1, 2));  // vertices lie in the order of their first use
}

TEST(Optimise, AMeshWithoutTrianglesBecomesEmpty) {
    TriMesh mesh;
    mesh.positions = {{1, 2, 3}};
    optimise_for_gpu(mesh);
    EXPECT_TRUE(mesh.positions.empty());
}

TEST(Optimise, RefusesABadIndex) {
    TriMesh mesh;
    mesh.positions = {{1, 2, 3}};
    mesh.triangles = {{0, 0, 1}};
    EXPECT_THROW(optimise_for_gpu(mesh), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
