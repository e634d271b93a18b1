#include "terrain/material/corner_blend.h"

#include "base/random.h"
#include "terrain/material/hat_blend.h"
#include "tests/terrain/material/map_samples.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

double weight_of(const CornerWeights& corners, int slot) {
    double sum = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(corners.count); ++k)
        sum += corners.slots[k] == slot ? double{corners.weights[k]} : 0.0;
    return sum;
}

std::vector<Material> ids_0_1_2() {
    auto materials = test::three_materials();
    materials[1].id = 1;
    materials[2].id = 2;
    return materials;
}

// Row DM-05: what an interpolated id cannot do.
TEST(CornerBlend, NoThirdMaterialBetweenIdsZeroAndTwo) {
    Raster<std::uint8_t> ids(2, 1);
    ids(1, 0) = 2;
    const auto materials = ids_0_1_2();
    const FadeTable fades = fade_table(materials);
    std::vector<double> literal(3);
    for (int i = 0; i <= 100; ++i) {
        const float x = 0.5F + static_cast<float>(i) / 100.0F;
        const CornerWeights corners = corner_weights(ids, fades, x, 0.5F);
        EXPECT_EQ(weight_of(corners, 1), 0.0);
        EXPECT_NEAR(weight_of(corners, 2), i / 100.0, 1e-6);
    }
    hat_weights(hat_breaks(materials), filtered_id(ids, 1.0, 0.5), literal);
    EXPECT_EQ(literal[1], 1.0);  // the literal form shows nothing but the third
}

class CornerBlendSeeds : public testing::TestWithParam<unsigned> {};

TEST_P(CornerBlendSeeds, SumIsOneAndPlainHatsGiveBilinearWeights) {
    const DescriptionMap map = test::random_map(6, 5, GetParam(), false);
    const FadeTable fades = fade_table(map.materials);
    Rng rng({.seed = GetParam(), .stream = 1});
    for (int i = 0; i < 200; ++i) {
        const double x = rng.uniform(-1.0, 7.0);
        const double y = rng.uniform(-1.0, 6.0);
        const CornerWeights corners =
            corner_weights(map.ids, fades, static_cast<float>(x), static_cast<float>(y));
        double expected[3] = {};
        for (int cy = -2; cy < 8; ++cy)
            for (int cx = -2; cx < 9; ++cx) {
                const double w = std::max(0.0, 1.0 - std::abs(x - cx - 0.5)) *
                                 std::max(0.0, 1.0 - std::abs(y - cy - 0.5));
                const int id = map.ids(std::clamp(cx, 0, 5), std::clamp(cy, 0, 4));
                expected[fades.slots[static_cast<std::size_t>(id)]] += w;
            }
        double sum = 0.0;
        for (int slot = 0; slot < 3; ++slot) {
            EXPECT_NEAR(weight_of(corners, slot), expected[slot], 2e-5);
            sum += weight_of(corners, slot);
        }
        EXPECT_NEAR(sum, 1.0, 1e-6);
    }
}

// Whatever the hats, weights are shares and change little over a small step.
TEST_P(CornerBlendSeeds, SharesAreContinuousForAnyWidth) {
    DescriptionMap map = test::random_map(6, 5, GetParam(), false);
    Rng rng({.seed = GetParam(), .stream = 2});
    for (Material& material : map.materials) {
        const double peak = material.id / 255.0;
        material.hat = {std::max(0.0, peak - rng.uniform(0.009, 0.03)), peak,
                        peak + rng.uniform(0.009, 0.03)};
    }
    const FadeTable fades = fade_table(map.materials);
    for (int i = 0; i < 2000; ++i) {
        const float x = static_cast<float>(i) * 6.0F / 2000.0F;
        const CornerWeights here = corner_weights(map.ids, fades, x, 2.2F);
        const CornerWeights next = corner_weights(map.ids, fades, x + 0.003F, 2.2F);
        double sum = 0.0;
        for (int slot = 0; slot < 3; ++slot) {
            EXPECT_NEAR(weight_of(here, slot), weight_of(next, slot), 0.06) << x;
            sum += weight_of(here, slot);
        }
        EXPECT_NEAR(sum, 1.0, 1e-6);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, CornerBlendSeeds, testing::Range(0U, 4U));

TEST(CornerBlend, AHatsSideSaysHowFarItFades) {
    Raster<std::uint8_t> ids(2, 1);
    ids(1, 0) = 2;
    auto materials = ids_0_1_2();
    materials[0].hat = {0.0, 0.0, 0.5 / 255.0};  // gone half-way up
    const FadeTable fades = fade_table(materials);
    EXPECT_EQ(fades.high[0], 0.5F);
    EXPECT_EQ(fades.low[2], 1.0F);
    const auto first = [&](float x) { return weight_of(corner_weights(ids, fades, x, 0.5F), 0); };
    EXPECT_NEAR(first(0.75F), 0.5 / (0.5 + 0.25), 1e-6);  // 1 - 0.25 / 0.5, against 0.25
    EXPECT_EQ(first(1.0F), 0.0);
    EXPECT_EQ(first(1.25F), 0.0);
}

TEST(CornerBlend, WithoutWidthTheNearestCellHasItAll) {
    Raster<std::uint8_t> ids(2, 1);
    ids(1, 0) = 2;
    auto materials = ids_0_1_2();
    for (Material& material : materials) {
        const double t = material.id / 255.0;
        material.hat = {t, t, t};
    }
    const FadeTable fades = fade_table(materials);
    EXPECT_EQ(weight_of(corner_weights(ids, fades, 0.9F, 0.5F), 0), 1.0);
    EXPECT_EQ(weight_of(corner_weights(ids, fades, 1.1F, 0.5F), 2), 1.0);
}

}  // namespace
}  // namespace scree::terrain
