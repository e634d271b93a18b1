#include "vision/classical/region_features.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// A disc of one basin on open ground, with a clean border.
MergeTree disc(double radius, double squeeze) {
    const int size = static_cast<int>(2 * radius * squeeze) + 12;
    EdgeField field{FloatRaster(size, size), FloatRaster(size, size, 0.1F),
                    FloatRaster(size, size)};
    BasinMap basins{Raster<std::int32_t>(size, size, kNoBasin), 1};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double r = std::hypot((x + 0.5 - size / 2.0) / squeeze, y + 0.5 - size / 2.0);
            field.boundary(x, y) = static_cast<float>(std::exp(-(r - radius) * (r - radius)));
            if (r < radius)
                basins.labels(x, y) = 0;
        }
    return build_merge_tree(basins, field, FloatRaster(size, size, 0.5F), 1.0F);
}

TEST(RegionFeatures, AreFiniteAndTellShape) {
    const auto round = region_features(disc(20, 1.0), 0);
    const auto longish = region_features(disc(20, 2.0), 0);
    EXPECT_TRUE(std::ranges::all_of(round, [](float v) { return std::isfinite(v); }));
    EXPECT_NEAR(round[0], std::log(3.14159 * 400), 0.02) << "logarithm of the area";
    EXPECT_GT(round[1], 0.7) << "mean boundary along the border";
    EXPECT_NEAR(round[4], 1.0, 1e-6) << "all of it is open";
    EXPECT_NEAR(round[16], 1.0, 0.01) << "an ellipse has the area of its moments' ellipse";
    EXPECT_NEAR(longish[16], 1.0, 0.01);
    EXPECT_NEAR(round[17], 0.0, 0.02) << "logarithm of the elongation";
    EXPECT_NEAR(longish[17], std::log(2.0), 0.02);
}

TEST(RegionFeatures, OfOnePixelAreFinite) {
    EdgeField field{FloatRaster(3, 3, 0.0F), FloatRaster(3, 3), FloatRaster(3, 3)};
    BasinMap basins{Raster<std::int32_t>(3, 3, kNoBasin), 1};
    basins.labels(1, 1) = 0;
    const auto tree = build_merge_tree(basins, field, FloatRaster(3, 3), 1.0F);
    for (const float v : region_features(tree, 0))
        EXPECT_TRUE(std::isfinite(v));
}

}  // namespace
}  // namespace scree::vision
