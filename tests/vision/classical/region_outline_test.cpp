#include "vision/classical/region_outline.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// One region: the pixels whose centre the predicate accepts, as a single basin.
template <class Inside>
RegionHierarchy painted(int width, int height, Inside inside) {
    RegionHierarchy h{{Raster<std::int32_t>(width, height, kNoBasin), 1}, {{RegionNode{}}, 1}};
    AreaStats& s = h.tree.nodes[0].pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double px = x + 0.5, py = y + 0.5;
            if (!inside(px, py))
                continue;
            h.basins.labels(x, y) = 0;
            s += AreaStats{1, px, py, px * px, py * py, px * py, 0, 0, 0, 0, 0, 0};
        }
    return h;
}

Outline outline_of(const RegionHierarchy& h) {
    return region_outline(RegionIndex(h), h.tree.nodes[0], 0, 1.5);
}

TEST(RegionOutline, OfADiscIsItsCircle) {
    for (const double radius : {4.0, 12.0, 45.0}) {
        const auto p = painted(
            120, 120, [&](double x, double y) { return std::hypot(x - 60.3, y - 58.8) < radius; });
        const Outline o = outline_of(p);
        EXPECT_NEAR(o.centre.x, 60.3, 0.25);
        EXPECT_NEAR(o.centre.y, 58.8, 0.25);
        EXPECT_NEAR(outline_area(o), std::numbers::pi * radius * radius,
                    0.03 * p.tree.nodes[0].pixels.area);
        for (const float r : o.radii)
            EXPECT_NEAR(r, radius, 0.5);
    }
}

TEST(RegionOutline, HolesCountAsRock) {
    const auto p = painted(80, 80, [](double x, double y) {
        const double r = std::hypot(x - 40, y - 40);
        return r < 30 && !(std::hypot(x - 50, y - 40) < 6);
    });
    const Outline o = outline_of(p);
    EXPECT_NEAR(outline_area(o), std::numbers::pi * 900, 0.02 * std::numbers::pi * 900);
}

TEST(RegionOutline, CentreOfACrescentLiesInIt) {
    const auto p = painted(100, 100, [](double x, double y) {
        return std::hypot(x - 50, y - 50) < 40 && std::hypot(x - 70, y - 50) > 36;
    });
    const Outline o = outline_of(p);
    EXPECT_EQ(p.basins.labels(static_cast<int>(o.centre.x), static_cast<int>(o.centre.y)), 0);
    for (const float r : o.radii)
        EXPECT_GT(r, 0);
}

TEST(RegionOutline, OfOnePixelIsPositive) {
    const auto p = painted(9, 9, [](double x, double y) { return x == 4.5 && y == 4.5; });
    const Outline o = outline_of(p);
    for (const float r : o.radii)
        EXPECT_GE(r, 0.5F);
}

}  // namespace
}  // namespace scree::vision
