#include "vision/learned/scale_choice.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

float logit(double share) {
    return static_cast<float>(std::log(share / (1.0 - share)));
}

LogitPlanes planes(int width, int height, float value) {
    LogitPlanes made;
    made.fill(FloatRaster(width, height, value));
    return made;
}

// Ground packed with square pyramids of the given width: rock everywhere, distance 0 to 1.
LogitPlanes pyramids(int width, int height, int rock) {
    LogitPlanes made = planes(width, height, logit(0.999));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double u = std::abs((x % rock + 0.5) / rock * 2.0 - 1.0);
            const double v = std::abs((y % rock + 0.5) / rock * 2.0 - 1.0);
            made[2](x, y) = logit(std::clamp(1.0 - std::max(u, v), 0.001, 0.999));
        }
    }
    return made;
}

TEST(ChooseShare, IsWholeForSmallRocksAndNothingForBigOnes) {
    const ScaleChoice choice{.full = 64, .none = 100};
    for (const int rock : {12, 20, 28}) {  // twice as wide at the finer scale
        const FineShare share = choose_share(pyramids(168, 168, rock), 336, 335, choice);
        EXPECT_EQ(share.by_place.width(), 336);
        EXPECT_EQ(share.by_place.height(), 335);
        EXPECT_NEAR(share.by_place(168, 168), 1.0, 0.02) << rock;
        EXPECT_FALSE(share.nothing_in({0, 336}, {0, 336}));
    }
    const FineShare share = choose_share(pyramids(420, 420, 60), 840, 840, choice);
    EXPECT_TRUE(share.nothing_in({320, 200}, {320, 200}));
}

TEST(ChooseShare, FollowsWhatIsSaidOfPlacesWithoutRock) {
    const LogitPlanes ground = planes(64, 64, -9.0F);
    EXPECT_EQ(choose_share(ground, 128, 128, {}).by_place(64, 64), 1.0F);
}

TEST(ChooseDoubtful, IsWholeWhereTheFieldIsOpenAndNothingWhereItIsSure) {
    FloatRaster inside(800, 200, logit(0.5));
    for (int y = 0; y < 200; ++y)
        std::fill(inside.row(y) + 400, inside.row(y) + 800, logit(y < 100 ? 0.98 : 0.02));
    const FineShare share = choose_doubtful(inside, 0.4);
    EXPECT_FLOAT_EQ(share.by_place(100, 100), 1.0F);
    EXPECT_TRUE(share.nothing_in({600, 200}, {0, 200}));
    float before = 1.0F;
    for (int x = 0; x < 800; ++x) {
        EXPECT_LE(share.by_place(x, 100), before + 1e-6F);
        before = share.by_place(x, 100);
    }
    EXPECT_FLOAT_EQ(choose_doubtful(FloatRaster(3, 2, 0.0F), 0.4).by_place(1, 1), 1.0F);
}

TEST(Enlarged, LiesOverTheSamePlaces) {
    FloatRaster ramp(20, 10);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x)
            ramp(x, y) = static_cast<float>(x + 0.5);
    const FloatRaster fine = enlarged(ramp, 39, 19);
    EXPECT_EQ(fine.width(), 39);
    for (int x = 1; x < 38; ++x)
        EXPECT_FLOAT_EQ(fine(x, 9), (static_cast<float>(x) + 0.5F) / 2.0F);
}

TEST(AddTile, ReplacesByShareAndLeavesOutWhatLiesBeyond) {
    LogitPlanes sum = planes(40, 32, 2.0F);
    FineShare share{FloatRaster(40, 32, 0.25F)};
    make_room(sum, share);
    const FineTile tile{
        {0, 64}, {0, 32}, std::vector<float>(64, 1.0F), std::vector<float>(32, 0.5F)};
    const std::vector<float> logits(3 * 64 * 32, 6.0F);
    add_tile(tile, logits, share, sum);
    add_tile(tile, logits, share, sum);
    for (const FloatRaster& plane : sum)
        for (const float value : plane)
            ASSERT_FLOAT_EQ(value, 0.75F * 2.0F + 0.25F * 6.0F);
}

TEST(Halve, TakesMeansOfFour) {
    std::vector<float> values(3 * 4 * 2);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(i);
    halve_planes(values, 4, 2);
    EXPECT_THAT(values, testing::ElementsAre(2.5F, 4.5F, 10.5F, 12.5F, 18.5F, 20.5F));
    const FineTile half = halved({{32, 4}, {64, 2}, {0, 0.5F, 1, 1}, {1, 1}});
    EXPECT_EQ(half.columns, (Span{16, 2}));
    EXPECT_EQ(half.rows, (Span{32, 1}));
    EXPECT_THAT(half.column_weights, testing::ElementsAre(0.25F, 1.0F));
}

}  // namespace
}  // namespace scree::vision
