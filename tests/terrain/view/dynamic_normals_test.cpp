#include "terrain/view/dynamic_normals.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(DynamicNormals, AreThoseOfAnAnalyticBump) {
    constexpr float cell = 0.01F;
    constexpr int n = 101;
    FloatRaster bump(n, n);
    const auto height = [](float x, float z) {
        return 0.05F * std::exp(-(x * x + 2.0F * z * z) / 0.04F);
    };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            bump(x, y) = height((static_cast<float>(x) - 50.0F) * cell,
                                (static_cast<float>(y) - 50.0F) * cell);
    for (int y = 1; y + 1 < n; ++y)
        for (int x = 1; x + 1 < n; ++x) {
            const float px = (static_cast<float>(x) - 50.0F) * cell;
            const float pz = (static_cast<float>(y) - 50.0F) * cell;
            const float h = height(px, pz);
            const glm::vec2 slopes(-2.0F * px / 0.04F * h, -4.0F * pz / 0.04F * h);
            expect_near(normal_of(slopes_at(bump, x, y, cell)), normal_of(slopes), 4e-3F);
        }
}

TEST(DynamicNormals, PlanesAreExactUpToTheRim) {
    FloatRaster plane(5, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x)
            plane(x, y) = 0.25F * static_cast<float>(x) - 0.5F * static_cast<float>(y);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(slopes_at(plane, x, y, 0.5F), glm::vec2(0.5F, -1.0F));
    EXPECT_EQ(slopes_at(FloatRaster(1, 1, 3.0F), 0, 0, 1.0F), glm::vec2(0.0F));
}

TEST(DynamicNormals, ShareGrowsToOneHalf) {
    EXPECT_EQ(dynamic_share({0.0F, 0.0F}), 0.0F);
    EXPECT_NEAR(dynamic_share({0.03F, 0.04F}), 0.25F, 1e-6F);
    EXPECT_EQ(dynamic_share({0.06F, 0.08F}), 0.5F);
    EXPECT_EQ(dynamic_share({3.0F, 0.0F}), 0.5F);
}

TEST(DynamicNormals, BlendIsLinearBeforeItIsMadeUnit) {
    const glm::vec3 mapped = glm::normalize(glm::vec3(0.3F, 0.9F, -0.1F));
    const glm::vec3 dynamic = normal_of({-0.4F, 0.2F});
    expect_near(blend_normals(mapped, dynamic, 0.0F), mapped, 1e-6F);
    expect_near(blend_normals(mapped, dynamic, 1.0F), dynamic, 1e-6F);
    expect_near(blend_normals(mapped, dynamic, 0.25F),
                glm::normalize(0.75F * mapped + 0.25F * dynamic), 1e-6F);
    EXPECT_NEAR(glm::length(blend_normals(mapped, dynamic, 0.4F)), 1.0F, 1e-6F);
}

}  // namespace
}  // namespace scree::terrain
