#include "terrain/material/hat_blend.h"

#include "base/random.h"
#include "tests/terrain/material/map_samples.h"

#include <numeric>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

// Row DM-04.
TEST(Hat, IsZeroAtItsEndsAndOneAtItsPeak) {
    EXPECT_EQ(hat(0.2, 0.3, 0.8, 0.2), 0.0);
    EXPECT_EQ(hat(0.2, 0.3, 0.8, 0.3), 1.0);
    EXPECT_EQ(hat(0.2, 0.3, 0.8, 0.8), 0.0);
    EXPECT_EQ(hat(0.2, 0.3, 0.8, 0.1), 0.0);
    EXPECT_EQ(hat(0.2, 0.3, 0.8, 0.9), 0.0);
}

TEST(Hat, SetsEachSideByItself) {
    EXPECT_NEAR(hat(0.2, 0.3, 0.8, 0.25), 0.5, 1e-12);
    EXPECT_NEAR(hat(0.2, 0.3, 0.8, 0.55), 0.5, 1e-12);
    EXPECT_NEAR(hat(0.2, 0.3, 0.8, 0.4), 0.8, 1e-12);
}

TEST(Hat, StepsWhereASideHasNoWidth) {
    EXPECT_EQ(hat(0.3, 0.3, 0.8, 0.3), 1.0);
    EXPECT_EQ(hat(0.3, 0.3, 0.8, 0.2999), 0.0);
    EXPECT_EQ(hat(0.3, 0.8, 0.8, 0.8), 1.0);
    EXPECT_EQ(hat(0.3, 0.8, 0.8, 0.8001), 0.0);
    EXPECT_EQ(hat(0.5, 0.5, 0.5, 0.5), 1.0);
}

TEST(HatWeights, AreAPartitionOfUnity) {
    auto materials = test::three_materials();
    for (const bool own : {false, true}) {
        if (own)
            materials[1].hat = {0.0, 0.01, 0.02};
        const auto breaks = hat_breaks(materials);
        std::vector<double> weights(3);
        for (int i = 0; i <= 1000; ++i) {
            hat_weights(breaks, i / 1000.0, weights);
            EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-12);
            for (const double weight : weights)
                EXPECT_GE(weight, 0.0);
        }
    }
}

TEST(HatWeights, GiveAMaterialItsOwnIdAndNeighboursTheRest) {
    const auto breaks = hat_breaks(test::three_materials());  // ids 0, 3 and 7
    std::vector<double> weights(3);
    hat_weights(breaks, 3.0 / 255.0, weights);
    EXPECT_THAT(weights, testing::ElementsAre(0.0, 1.0, 0.0));
    hat_weights(breaks, 1.0 / 255.0, weights);
    EXPECT_NEAR(weights[0], 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(weights[1], 1.0 / 3.0, 1e-12);
    hat_weights(breaks, 0.9, weights);  // beyond the last: one-sided
    EXPECT_THAT(weights, testing::ElementsAre(0.0, 0.0, 1.0));
}

TEST(HatWeights, OneMaterialHasItAll) {
    const auto breaks = hat_breaks({test::three_materials()[1]});
    std::vector<double> weights(1);
    for (const double t : {0.0, 0.5, 1.0}) {
        hat_weights(breaks, t, weights);
        EXPECT_EQ(weights[0], 1.0);
    }
}

TEST(HatWeights, AGapGoesToTheNearestPeak) {
    auto materials = test::three_materials();
    materials[0].hat = {0.0, 0.0, 0.1};
    materials[1].hat = {0.4, 0.5, 0.6};
    materials[2].hat = {0.9, 1.0, 1.0};
    std::vector<double> weights(3);
    hat_weights(hat_breaks(materials), 0.3, weights);
    EXPECT_THAT(weights, testing::ElementsAre(0.0, 1.0, 0.0));
}

TEST(FilteredId, IsBilinearBetweenCentres) {
    Raster<std::uint8_t> ids(3, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            ids(x, y) = static_cast<std::uint8_t>(10 * x + 100 * y);
    EXPECT_NEAR(filtered_id(ids, 1.25, 1.0), (7.5 + 50.0) / 255.0, 1e-12);
    EXPECT_NEAR(filtered_id(ids, -5.0, 0.5), 0.0, 1e-12);
    EXPECT_NEAR(filtered_id(ids, 9.0, 9.0), 120.0 / 255.0, 1e-12);
}

}  // namespace
}  // namespace scree::terrain
