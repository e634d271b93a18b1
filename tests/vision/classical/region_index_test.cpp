#include "vision/classical/region_index.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

TEST(RegionIndex, KnowsTheRegionsOfEveryPixel) {
    RegionHierarchy h;  // basins 0 to 3; 4 = 0 + 2, 5 = 4 + 3; 1 stays alone
    h.basins = {Raster<std::int32_t>(5, 1), 4};
    for (int x = 0; x < 5; ++x)
        h.basins.labels(x, 0) = x < 4 ? x : kNoBasin;
    h.tree.n_basins = 4;
    h.tree.nodes.resize(6);
    const auto unite = [&](int whole, int left, int right) {
        auto& nodes = h.tree.nodes;
        nodes[static_cast<std::size_t>(whole)].left = left;
        nodes[static_cast<std::size_t>(whole)].right = right;
        for (const int part : {left, right})
            nodes[static_cast<std::size_t>(part)].parent = whole;
    };
    unite(4, 0, 2);
    unite(5, 4, 3);

    const RegionIndex index(h);

    const std::vector<std::vector<int>> members = {{0}, {1}, {2}, {3}, {0, 2}, {0, 2, 3}};
    for (int region = 0; region < 6; ++region)
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(index.holds(region, x, 0),
                      std::ranges::count(members[static_cast<std::size_t>(region)], x) > 0)
                << "region " << region << ", pixel " << x;
    EXPECT_TRUE(index.is_open(4, 0));
    EXPECT_FALSE(index.is_open(3, 0));
}

}  // namespace
}  // namespace scree::vision
