#pragma once

#include "meshing/mesh/topology.h"

#include <gtest/gtest.h>

namespace scree::test {

/// Expect a closed, oriented manifold in one piece without handles, of positive volume and without
/// triangles that have no area. Every test that makes a rock ends with it.
inline void expect_valid(const meshing::TriMesh& mesh) {
    EXPECT_EQ(meshing::solid_defect(mesh), "");
    const meshing::TopologyReport report = meshing::analyse_topology(mesh);
    EXPECT_EQ(report.n_pieces, 1U);
    EXPECT_EQ(report.n_boundaries, 0U);
    EXPECT_EQ(report.genus, 0);
}

}  // namespace scree::test
