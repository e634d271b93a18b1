#include "meshing/bake/mesh_height_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/bake/height_bake.h"
#include "tests/support/placed_rocks.h"

#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

std::vector<TriMesh> meshes_of(const vision::RockSet& set, int rings, int segments) {
    std::vector<TriMesh> meshes;
    for (const vision::Rock& rock : set.rocks)
        meshes.push_back(test::rock_surface(rock, set, rings, segments));
    return meshes;
}

std::vector<PlacedMesh> placed(const vision::RockSet& set, const std::vector<TriMesh>& meshes) {
    std::vector<PlacedMesh> all;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        all.push_back(
            {&meshes[i], glm::translate(glm::dmat4(1.0), test::rock_place(set.rocks[i], set))});
    return all;
}

// Rings stand steep at the border, so the inscribed mesh falls short there most of all: the
// tolerance is a share of the depth in the middle, and counts pixels at the border.
TEST(MeshHeightBake, AgreesWithTheClosedFormWithinMeshTolerance) {
    const auto set = test::scattered_rocks(240, 200, 25, 8.0, 40.0, 3);
    const auto meshes = meshes_of(set, 90, 180);
    const auto raster = bake_mesh_heights(placed(set, meshes), {240, 200, 0.002});
    const auto exact = bake_displacement(set);
    const double tallest = *std::max_element(exact.metres.begin(), exact.metres.end());
    double worst = 0.0;
    double sum = 0.0;
    int n_above = 0;
    for (std::size_t i = 0; i < exact.metres.size(); ++i) {
        const double wanted = exact.metres.data()[i];
        if (wanted < 0.2 * tallest)
            continue;
        const double error = std::abs(raster.metres.data()[i] - wanted);
        worst = std::max(worst, error);
        sum += error;
        ++n_above;
    }
    ASSERT_GT(n_above, 5000);
    EXPECT_LT(sum / n_above, 5e-4 * tallest);
    EXPECT_LT(worst, 0.02 * tallest);
}

TEST(MeshHeightBake, FinerMeshesComeCloser) {
    const auto set = test::scattered_rocks(160, 120, 12, 8.0, 30.0, 5);
    const auto exact = bake_displacement(set);
    double before = 1e9;
    for (const int rings : {8, 16, 32, 64}) {
        const auto meshes = meshes_of(set, rings, 2 * rings);
        const auto raster = bake_mesh_heights(placed(set, meshes), {160, 120, 0.002});
        double sum = 0.0;
        for (std::size_t i = 0; i < exact.metres.size(); ++i)
            sum += std::abs(raster.metres.data()[i] - exact.metres.data()[i]);
        EXPECT_LT(sum, 0.6 * before) << rings;
        before = sum;
    }
}

TEST(MeshHeightBake, WrappingFramesMeetAtTheirBorders) {
    const auto set = test::scattered_rocks(64, 64, 1, 20.0, 20.0, 9);
    const TriMesh mesh = test::rock_surface(set.rocks[0], set, 24, 48);
    const auto at = [&](double x, double z) {
        const glm::dvec3 place(x * 0.002, 0.0, z * 0.002);
        return std::vector<PlacedMesh>{{&mesh, glm::translate(glm::dmat4(1.0), place)}};
    };
    const auto middle = bake_mesh_heights(at(0, 0), {64, 64, 0.002, true});
    const auto corner = bake_mesh_heights(at(32, -32), {64, 64, 0.002, true});
    const auto far_off = bake_mesh_heights(at(32 - 640, -32 + 64), {64, 64, 0.002, true});
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            ASSERT_NEAR(corner.metres((x + 32) % 64, (y + 32) % 64), middle.metres(x, y), 1e-6);
            ASSERT_NEAR(far_off.metres(x, y), corner.metres(x, y), 1e-6);
        }
}

TEST(MeshHeightBake, SameBytesForEveryThreadCount) {
    const auto set = test::scattered_rocks(200, 300, 60, 4.0, 40.0, 11);
    const auto meshes = meshes_of(set, 12, 24);
    const ThreadLimit one(1);
    const auto alone = bake_mesh_heights(placed(set, meshes), {200, 300, 0.002, true});
    const ThreadLimit more(0);
    EXPECT_EQ(bake_mesh_heights(placed(set, meshes), {200, 300, 0.002, true}).metres, alone.metres);
}

TEST(MeshHeightBakeErrors, RefuseWhatCannotBeDrawn) {
    const auto set = test::scattered_rocks(64, 64, 1, 20.0, 20.0, 9);
    TriMesh mesh = test::rock_surface(set.rocks[0], set, 8, 16);
    const PlacedMesh good{&mesh};
    const PlacedMesh none{};
    EXPECT_THROW(bake_mesh_heights({&good, 1}, {0, 64, 0.002}), InvalidInput);
    EXPECT_THROW(bake_mesh_heights({&good, 1}, {1 << 20, 1 << 20, 0.002}), InvalidInput);
    EXPECT_THROW(bake_mesh_heights({&good, 1}, {64, 64, 0.0}), InvalidInput);
    EXPECT_THROW(bake_mesh_heights({&none, 1}, {64, 64, 0.002}), InvalidInput);
    EXPECT_THROW(bake_mesh_heights({&good, 1}, {64, 64, 1e-9, true}), InvalidInput);
    PlacedMesh lost{&mesh};
    lost.world_from_mesh[3].x = std::numeric_limits<double>::infinity();
    EXPECT_THAT(
        [&] {
            bake_mesh_heights({&lost, 1}, {64, 64, 0.002});
        },
        testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("mesh 0 is placed")));
    mesh.triangles.emplace_back(0, 1, 100000);
    EXPECT_THROW(bake_mesh_heights({&good, 1}, {64, 64, 0.002}), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
