#include "vision/classical/pixel_features.h"

#include "testdata/synthetic_photo.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

LightLevel sample_level() {
    const auto made = test::make_synthetic_photo({.width = 200, .height = 160, .n_rocks = 60});
    return light_pyramid(made.photo).fine[0];
}

TEST(PixelFeatures, DoNotDependOnWhereAStripEnds) {
    const LightLevel level = sample_level();
    const FeatureStrip whole(level, {}, 0, level.height), part(level, {}, 50, 67);
    ASSERT_EQ(whole.count(), part.count());
    for (int i = 0; i < whole.count(); ++i)
        for (int y = 50; y < 67; ++y)
            for (int x = 0; x < level.width; ++x)
                ASSERT_EQ(whole.row(i, y)[x], part.row(i, y)[x]) << "value " << i;
}

TEST(PixelFeatures, AreFinite) {
    const LightLevel level = sample_level();
    const FeatureStrip strip(level, {}, 0, level.height);
    for (int i = 0; i < strip.count(); ++i)
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                ASSERT_TRUE(std::isfinite(strip.row(i, y)[x]));
}

TEST(PixelFeatures, ContextAddsItsOwn) {
    const LightLevel level = sample_level();
    const Context context(3, FloatRaster(level.width + 2 * LightLevel::kMargin,
                                         level.height + 2 * LightLevel::kMargin, 0.25F));
    const FeatureStrip without(level, {}, 0, 8), with(level, context, 0, 8);
    ASSERT_GT(with.count(), without.count());
    EXPECT_EQ(with.row(with.count() - 1, 3)[5], 0.25F);
}

}  // namespace
}  // namespace scree::vision
