#include "terrain/surface/round_rocks.h"

#include "base/error.h"
#include "meshing/mesh/topology.h"
#include "tests/support/rock_samples.h"
#include "tests/support/worn_shapes.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(RoundRocks, RoundsAndKeepsTheVolume) {
    const auto before = meshing::build_rock_meshes(test::rock_set(12, 3));
    auto rocks = before;
    terrain::round_rocks(rocks, 50);
    for (std::size_t i = 0; i < rocks.size(); ++i) {
        const meshing::TriMesh& mesh = rocks[i].mesh;
        EXPECT_EQ(meshing::solid_defect(mesh), "");
        EXPECT_NEAR(meshing::signed_volume(mesh) / meshing::signed_volume(before[i].mesh), 1.0,
                    1e-3);
        EXPECT_GT(test::sphericity(mesh), test::sphericity(before[i].mesh));
        EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
        EXPECT_EQ(mesh.texcoords.size(), mesh.positions.size());
        EXPECT_LE(rocks[i].inscribed_radius, rocks[i].bounding_radius);
        EXPECT_EQ(rocks[i].position, before[i].position);
    }
}

TEST(RoundRocks, DoNothingInNoSteps) {
    const auto before = meshing::build_rock_meshes(test::rock_set(3, 1));
    auto rocks = before;
    terrain::round_rocks(rocks, 0);
    for (std::size_t i = 0; i < rocks.size(); ++i)
        EXPECT_EQ(rocks[i].mesh.positions, before[i].mesh.positions);
    EXPECT_THROW(terrain::round_rocks(rocks, -1), InvalidOption);
}

}  // namespace
}  // namespace scree
