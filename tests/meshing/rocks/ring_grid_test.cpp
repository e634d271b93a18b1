#include "meshing/rocks/ring_grid.h"

#include "base/error.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

unsigned largest_index(const std::vector<glm::uvec3>& triangles) {
    unsigned largest = 0;
    for (const glm::uvec3& t : triangles)
        largest = std::max({largest, t.x, t.y, t.z});
    return largest;
}

TEST(RingGrid, ShearedHasTheCountsOfTheSource) {
    const RingGrid grid{.segments = 30, .rings = 16, .layout = RingLayout::Sheared};
    const auto triangles = ring_triangles(grid);
    EXPECT_EQ(vertex_count(grid), 527U);
    EXPECT_EQ(largest_index(triangles), 526U);
    EXPECT_EQ(triangles.size(), 992U);
    EXPECT_EQ(3 * triangles.size(), 6U * 16U * 31U);
    EXPECT_EQ(triangles[0], glm::uvec3(0, 30, 31));
    EXPECT_EQ(triangles[1], glm::uvec3(31, 1, 0));
}

TEST(RingGrid, OtherLayoutsUseEveryVertexOfNoMore) {
    for (const RingLayout layout : {RingLayout::Shared, RingLayout::Seamed}) {
        for (int segments = 3; segments < 9; ++segments) {
            for (int rings = 2; rings < 7; ++rings) {
                const RingGrid grid{segments, rings, layout};
                const auto triangles = ring_triangles(grid);
                std::vector<bool> used(vertex_count(grid), false);
                ASSERT_LT(largest_index(triangles), used.size());
                for (const glm::uvec3& t : triangles)
                    used[t.x] = used[t.y] = used[t.z] = true;
                EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
                EXPECT_EQ(static_cast<int>(triangles.size()), 2 * segments * (rings - 1));
            }
        }
    }
}

TEST(RingGrid, MeetsAVertexBudget) {
    EXPECT_EQ(vertex_count({.segments = 64, .rings = 41}), 2562U);
}

TEST(RingGrid, NamesTheValueAndTheRange) {
    EXPECT_THAT([] { ring_triangles({.segments = 2}); },
                testing::ThrowsMessage<InvalidOption>("segments is 2, must be in [3, 4096]"));
    EXPECT_THROW(ring_triangles({.segments = 3, .rings = 1}), InvalidOption);
    EXPECT_THROW(ring_triangles({.segments = 5000}), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
