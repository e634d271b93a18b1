#include "terrain/prepare/ground_lattice.h"

#include "base/error.h"
#include "meshing/mesh/topology.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::GroundLattice;
using terrain::Heightfield;
using terrain::lattice_mesh;
using terrain::lattice_of;
using terrain::lattice_over;
using testing::HasSubstr;
using testing::ThrowsMessage;

Heightfield sloping(int width, int height, double cell) {
    Heightfield field{FloatRaster(width, height), cell};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            field.heights(x, y) =
                static_cast<float>(5.0 + 0.5 * (x + 0.5) * cell - 0.25 * y * cell);
    return field;
}

TEST(GroundLattice, SpreadsItsPlacesEvenly) {
    const GroundLattice ground = lattice_over({10, 20}, {40, 30}, 1200);
    EXPECT_NEAR(static_cast<double>(ground.heights.size()), 1200.0, 40.0);
    EXPECT_NEAR(ground.step.x / ground.step.y, 1.0, 0.1);
    EXPECT_EQ(ground.place(0, 0), glm::dvec2(10, 20));
    const glm::dvec2 last = ground.place(ground.heights.width() - 1, ground.heights.height() - 1);
    EXPECT_NEAR(last.x, 40.0, 1e-12);
    EXPECT_NEAR(last.y, 30.0, 1e-12);
}

TEST(GroundLattice, KeepsAPlaneAtAnyDensity) {
    for (const std::size_t n : {4U, 50U, 700U, 9000U}) {
        const GroundLattice ground = lattice_of(sloping(40, 25, 2.0), n);
        for (int j = 0; j < ground.heights.height(); ++j)
            for (int i = 0; i < ground.heights.width(); ++i) {
                const glm::dvec2 p = ground.place(i, j);
                EXPECT_NEAR(ground.heights(i, j), 5.0 + 0.5 * p.x - 0.25 * (p.y - 1.0), 1e-5);
            }
    }
}

TEST(GroundLattice, InterpolatesAmongWhatIsKnown) {
    GroundLattice ground = lattice_over({0, 0}, {1, 1}, 4);
    ground.heights(0, 0) = 1.0F;
    ground.heights(1, 0) = 3.0F;
    EXPECT_DOUBLE_EQ(height_at(ground, 0.5, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(height_at(ground, 0.25, 0.5), 1.5);
    EXPECT_TRUE(std::isnan(height_at(ground, 0.5, 1.0)));
    EXPECT_TRUE(std::isnan(height_at(ground, -0.01, 0.5)));
    EXPECT_TRUE(std::isnan(height_at(ground, std::nan(""), 0.5)));
}

TEST(GroundLattice, MakesASheetThatLooksUp) {
    const auto mesh = lattice_mesh(lattice_of(sloping(20, 30, 1.0), 600));
    EXPECT_EQ(mesh.triangles.size(), 2U * 19U * 29U);
    for (const glm::uvec3& t : mesh.triangles)
        EXPECT_GT(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                             mesh.positions[t.z] - mesh.positions[t.x])
                      .y,
                  0.0F);
}

TEST(GroundLattice, LeavesUnknownPlacesOut) {
    GroundLattice ground = lattice_of(sloping(20, 20, 1.0), 400);
    for (int j = 5; j < 10; ++j)
        for (int i = 5; i < 10; ++i)
            ground.heights(i, j) = std::numeric_limits<float>::quiet_NaN();
    ground.heights(19, 19) = std::numeric_limits<float>::quiet_NaN();
    const auto mesh = lattice_mesh(ground);
    EXPECT_EQ(mesh.positions.size(), 400U - 26U);
    const auto topology = meshing::analyse_topology(mesh);
    EXPECT_TRUE(topology.manifold);
    EXPECT_EQ(topology.n_boundaries, 2U);
    // The hole takes 6 x 6 cells, of which one triangle stays at each corner; so does the rim's.
    EXPECT_EQ(mesh.triangles.size(), 2U * (19U * 19U - 36U) + 4U - 1U);
}

TEST(GroundLattice, RefusesNoGround) {
    EXPECT_THAT(
        [] {
            lattice_over({0, 0}, {0, 5}, 10);
        },
        ThrowsMessage<InvalidInput>(HasSubstr("the ground measures 0 x 5 m")));
    EXPECT_THAT(
        [] {
            lattice_over({0, 0}, {5, 5}, std::size_t{1} << 30U);
        },
        ThrowsMessage<InvalidInput>(HasSubstr("ask for fewer vertices")));
    EXPECT_LE(lattice_over({0, 0}, {1e12, 1e-3}, 10'000).heights.size(), 20'000U);
    EXPECT_THROW(lattice_of(Heightfield{FloatRaster(1, 5), 1.0}, 10), InvalidInput);
    EXPECT_THAT(
        [] {
            lattice_mesh(lattice_over({0, 0}, {1, 1}, 100));
        },
        ThrowsMessage<InvalidInput>(HasSubstr("nowhere are three places")));
}

}  // namespace
}  // namespace scree
