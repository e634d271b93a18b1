#include "terrain/prepare/terrain_mesh.h"

#include "base/error.h"
#include "meshing/mesh/topology.h"
#include "meshing/space/self_intersection.h"
#include "terrain/prepare/river_bed.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace scree {
namespace {

using terrain::GroundLattice;
using terrain::Heightfield;
using terrain::places_for;
using terrain::terrain_mesh;
using terrain::TerrainMeshOptions;

Heightfield hills(int side) {
    Heightfield field{FloatRaster(side, side), 100.0 / side};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            field.heights(x, y) =
                static_cast<float>(4.0 * std::sin(12.0 * x / side) * std::cos(9.0 * y / side));
    return field;
}

meshing::TriMesh river(const TerrainMeshOptions& options) {
    GroundLattice ground = terrain::lattice_of(hills(120), places_for(options, 120 * 120));
    terrain::cut_bed(ground, {{{0, 30}, {50, 60}, {100, 50}}, {.width = 8, .depth = 3, .bank = 4}});
    return terrain_mesh(ground, options);
}

TEST(TerrainMesh, HasTheWantedSize) {
    for (const std::int64_t vertices : {50, 1000, 3000, 15000, 20000}) {
        const auto mesh = river({.vertices = vertices});
        EXPECT_EQ(mesh.positions.size(), static_cast<std::size_t>(vertices));
        const auto topology = meshing::analyse_topology(mesh);
        EXPECT_TRUE(topology.manifold);
        EXPECT_EQ(topology.n_boundaries, 1U);
        EXPECT_EQ(topology.n_pieces, 1U);
    }
}

TEST(TerrainMesh, KeepsTheBedAndTangleNothing) {
    const auto mesh = river({.vertices = 1500});
    const auto crossings = meshing::find_self_intersections(mesh, meshing::build_adjacency(mesh));
    EXPECT_TRUE(crossings.pairs.empty());
    // Over the middle of the line the sheet lies 3 m below the hills.
    const Heightfield land = hills(120);
    std::size_t n = 0;
    for (const glm::vec3& p : mesh.positions) {
        const double x = static_cast<double>(p.x), z = static_cast<double>(p.z);
        if (x > 50.0 || std::abs(z - (30.0 + 0.6 * x)) > 2.0)
            continue;
        ++n;
        EXPECT_LT(p.y, height_at(land, x, z) - 1.5);
    }
    EXPECT_GT(n, 20U);
}

TEST(TerrainMesh, StaysWithinItsSamplesHeights) {
    const auto mesh = terrain_mesh(terrain::lattice_of(hills(100), 4000), {.vertices = 1000});
    const Heightfield land = hills(100);
    for (const glm::vec3& p : mesh.positions)
        EXPECT_NEAR(p.y, height_at(land, static_cast<double>(p.x), static_cast<double>(p.z)), 1e-4);
}

TEST(TerrainMesh, AsksForNoMorePlacesThanThereAre) {
    EXPECT_EQ(places_for({.vertices = 1000}, 1'000'000), 4000U);
    EXPECT_EQ(places_for({.vertices = 1000}, 2500), 2500U);
    EXPECT_GE(places_for({.vertices = 1000}, 10), 1000U);
    EXPECT_EQ(places_for({.vertices = 4'000'000, .oversampling = 16}, 1U << 30U),
              terrain::kMostLatticePlaces);
    EXPECT_THROW(places_for({.vertices = 0}, 10), InvalidOption);
    EXPECT_THROW(terrain_mesh(terrain::lattice_of(hills(10), 100), {.evenness = 2}), InvalidOption);
}

}  // namespace
}  // namespace scree
