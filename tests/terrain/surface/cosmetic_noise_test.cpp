#include "terrain/surface/cosmetic_noise.h"

#include "base/error.h"
#include "tests/support/mesh_shapes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::TriMesh;

TEST(CosmeticNoise, StaysWithinItsAmplitudeAndOffTheRim) {
    const TriMesh flat = test::sheet(12, 0.5F);
    const auto adjacency = meshing::build_adjacency(flat);
    const double most = 0.1 * meshing::mean_edge_length(flat, adjacency);
    TriMesh mesh = flat;
    terrain::roughen(mesh, adjacency, 0.1, 1);
    double sum = 0.0, greatest = 0.0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 way = mesh.positions[v] - flat.positions[v];
        EXPECT_EQ(way.x, 0.0F);
        EXPECT_EQ(way.z, 0.0F);
        if (adjacency.rim[v] != 0) {
            EXPECT_EQ(way.y, 0.0F);
        }
        sum += static_cast<double>(way.y);
        greatest = std::max(greatest, static_cast<double>(std::abs(way.y)));
    }
    EXPECT_LE(greatest, most * 1.001);
    EXPECT_GT(greatest, 0.8 * most);
    EXPECT_LT(std::abs(sum), 0.25 * most * static_cast<double>(mesh.positions.size()));
}

TEST(CosmeticNoise, DependsOnTheSeedAlone) {
    const TriMesh start = test::icosphere(3);
    const auto adjacency = meshing::build_adjacency(start);
    TriMesh one = start, again = start, other = start, none = start;
    terrain::roughen(one, adjacency, 0.2, 1);
    terrain::roughen(again, adjacency, 0.2, 1);
    terrain::roughen(other, adjacency, 0.2, 2);
    terrain::roughen(none, adjacency, 0.0, 1);
    EXPECT_EQ(one.positions, again.positions);
    EXPECT_NE(one.positions, other.positions);
    EXPECT_EQ(none.positions, start.positions);
    EXPECT_THROW(terrain::roughen(one, adjacency, -1.0, 1), InvalidInput);
    EXPECT_THROW(terrain::roughen(one, adjacency, std::nan(""), 1), InvalidInput);
}

}  // namespace
}  // namespace scree
