#include "vision/classical/region_hierarchy.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// Two discs that touch nearly, on ground that belongs to no rock.
EdgeField two_discs() {
    EdgeField field{FloatRaster(120, 60), FloatRaster(120, 60), FloatRaster(120, 60)};
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 120; ++x) {
            const double r = std::min(std::hypot(x + 0.5 - 33, y + 0.5 - 30),
                                      std::hypot(x + 0.5 - 86, y + 0.5 - 30));
            field.boundary(x, y) = static_cast<float>(std::exp(-(r - 25) * (r - 25) / 2));
            field.inside(x, y) = r < 25 ? 0.9F : 0.1F;
            field.distance(x, y) = static_cast<float>(std::max(0.0, 1 - r / 25));
        }
    return field;
}

TEST(RegionHierarchy, HoldsBothDiscsAsRegions) {
    const RegionHierarchy h = region_hierarchy(Photo(120, 60), two_discs());
    for (const double x : {33.0, 86.0}) {
        const bool found = std::ranges::any_of(h.tree.nodes, [&](const RegionNode& n) {
            return std::abs(n.pixels.area - 3.14159 * 625) < 60 &&
                   std::abs(n.pixels.x / n.pixels.area - x) < 0.5;
        });
        EXPECT_TRUE(found) << "disc at " << x;
    }
}

TEST(RegionHierarchy, GroundBelongsToNoRegion) {
    const RegionHierarchy h = region_hierarchy(Photo(120, 60), two_discs());
    EXPECT_EQ(h.basins.labels(0, 0), kNoBasin);
    EXPECT_EQ(h.basins.labels(60, 3), kNoBasin);
    EXPECT_NE(h.basins.labels(33, 30), kNoBasin);
}

}  // namespace
}  // namespace scree::vision
