#include "vision/classical/outline_features.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

constexpr double kRadius = 30;

// The field of one disc, perfect but for a stretch of its border.
EdgeField disc_field(double gap_degrees) {
    EdgeField field{FloatRaster(100, 100), FloatRaster(100, 100), FloatRaster(100, 100)};
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            const double dx = x + 0.5 - 50, dy = y + 0.5 - 50, r = std::hypot(dx, dy);
            const double angle = std::abs(std::atan2(dy, dx)) * 180 / 3.14159265358979;
            const double away = r - kRadius;
            field.boundary(x, y) =
                angle < gap_degrees / 2 ? 0.0F : static_cast<float>(std::exp(-away * away));
            field.inside(x, y) = r < kRadius ? 1.0F : 0.0F;
            field.distance(x, y) = static_cast<float>(std::max(0.0, 1 - r / kRadius));
        }
    return field;
}

Outline circle(double radius) {
    Outline o;
    o.centre = {50, 50};
    o.radii.fill(static_cast<float>(radius));
    return o;
}

TEST(OutlineFeatures, OfAPerfectDisc) {
    const auto f = outline_features(circle(kRadius), disc_field(0));
    EXPECT_GT(f[0], 0.7F) << "mean border";
    EXPECT_GT(f[1], 0.6F) << "weakest tenth";
    EXPECT_EQ(f[4], 0.0F) << "no gap";
    EXPECT_LT(f[6], 0.01F) << "nothing within";
    EXPECT_NEAR(f[7], 1.0F, 1e-6F);
    EXPECT_NEAR(f[8], 0.0F, 1e-6F);
    EXPECT_NEAR(f[10], 0.0F, 0.03F) << "a cone";
    EXPECT_NEAR(f[11], 1.0F, 1e-3F) << "convex";
    EXPECT_NEAR(f[12], 0.0F, 1e-6F) << "round";
}

TEST(OutlineFeatures, TellGapsAndWrongSizes) {
    EXPECT_NEAR(outline_features(circle(kRadius), disc_field(90))[4], 0.25F, 0.05F);
    EXPECT_LT(outline_features(circle(20), disc_field(0))[0], 0.05F);
    EXPECT_GT(outline_features(circle(43), disc_field(0))[6], 0.6F) << "a border within";
}

TEST(OutlineFeatures, DentsLowerConvexity) {
    Outline dented = circle(kRadius);
    for (std::size_t k = 80; k < 110; ++k)
        dented.radii[k] = 15;
    EXPECT_LT(outline_features(dented, disc_field(0))[11], 0.96F);
}

TEST(OutlineFeatures, AreFiniteAtTheEdgeOfThePicture) {
    Outline o = circle(kRadius);
    o.centre = {0.5, 99};
    for (const float v : outline_features(o, disc_field(0)))
        EXPECT_TRUE(std::isfinite(v));
}

}  // namespace
}  // namespace scree::vision
