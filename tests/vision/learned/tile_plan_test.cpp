#include "vision/learned/tile_plan.h"

#include "vision/learned/outline_network.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(PlanTiles, OneTileWhereItFits) {
    EXPECT_THAT(plan_tiles(928, 1024, 48), testing::ElementsAre(Span{0, 928}));
    EXPECT_THAT(plan_tiles(1024, 1024, 48), testing::ElementsAre(Span{0, 1024}));
}

TEST(PlanTiles, EqualTilesCoverTheSideAndOverlap) {
    for (const int margin : {16, 48, 96}) {
        for (int length = 800; length <= 12000; length += kNetworkStep) {
            const auto tiles = plan_tiles(length, 768, margin);
            ASSERT_EQ(tiles.front().begin, 0);
            ASSERT_EQ(tiles.back().end(), length);
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                ASSERT_EQ(tiles[i].begin % kNetworkStep, 0);
                ASSERT_EQ(tiles[i].size, tiles[0].size);
                ASSERT_LE(tiles[i].size, 768);
                const int overlap = i > 0 ? tiles[i - 1].end() - tiles[i].begin : 2 * margin;
                ASSERT_GE(overlap, 2 * margin) << length;
            }
        }
    }
}

TEST(PlanTiles, WasteIsSmallWhereOneTileNearlyFits) {
    const auto tiles = plan_tiles(1056, 1024, 48);
    EXPECT_THAT(tiles, testing::ElementsAre(Span{0, 576}, Span{480, 576}));
}

TEST(TileWeights, AddUpToOneAndTrustNoTileAtItsEdge) {
    for (int length = 800; length <= 9000; length += 5 * kNetworkStep) {
        const auto tiles = plan_tiles(length, 768, 96);
        std::vector<float> sum(static_cast<std::size_t>(length));
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const std::vector<float> weights = tile_weights(tiles, i);
            for (std::size_t x = 0; x < weights.size(); ++x)
                sum[static_cast<std::size_t>(tiles[i].begin) + x] += weights[x];
            EXPECT_EQ(weights[47], i > 0 ? 0.0F : 1.0F);
            EXPECT_EQ(weights[weights.size() - 48], i + 1 < tiles.size() ? 0.0F : 1.0F);
        }
        for (const float one : sum)
            ASSERT_NEAR(one, 1.0F, 1e-6F) << length;
    }
}

}  // namespace
}  // namespace scree::vision
