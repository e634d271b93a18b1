#include "terrain/grid/settle.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/grid/sound_step.h"
#include "tests/support/sand_piles.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

Heightfield flat(int width, int height, double cell_size = 1.0) {
    return {FloatRaster(width, height), cell_size};
}

FloatRaster explicit_rest(const Heightfield& base, const SoilTile& soil, FloatRaster u) {
    const SoundRule rule = sound_rule(base, {});
    for (int step = 0; step < 40000; ++step) {
        if (step % 50 == 0 && test::steepest_over_deg(u, soil, base.cell_size) <= 0.5)
            break;
        u = sound_step(base, soil, {}, u, rule).displacement;
    }
    return u;
}

TEST(Settle, BringsAConeToItsReposeAndKeepsItsVolume) {
    const Heightfield base = flat(128, 128, 0.25);
    const SoilTile soil = test::two_soils(128, 30, 30);
    FloatRaster u = test::cone(128, 32, 2.0, 0.25);
    const double before = test::sum_of(u);
    const SettleReport report = settle_to_rest(u, base, soil);
    EXPECT_LE(test::steepest_over_deg(u, soil, 0.25), 0.1);
    EXPECT_GT(test::steepest_over_deg(u, soil, 0.25), -0.1);  // slid no further than needed
    EXPECT_NEAR(test::sum_of(u), before, 1e-6 * before);
    EXPECT_NEAR(report.excess_before, 2.0 - std::tan(std::numbers::pi / 6), 1e-3);
    EXPECT_LE(report.excess, 0.001);
    EXPECT_LT(report.sweeps, 200);
    EXPECT_GT(report.moved_m3, 0.2 * before * 0.25 * 0.25);
}

TEST(Settle, EndsNearTheRestOfTheExplicitScheme) {
    const Heightfield base = flat(64, 64);
    const SoilTile soil = test::two_soils(64, 30, 40);
    FloatRaster u = test::cone(64, 14, 2.0);
    const double volume = test::sum_of(u);
    const FloatRaster slow = explicit_rest(base, soil, u);
    settle_to_rest(u, base, soil);
    double apart = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
        apart += std::abs(static_cast<double>(u.data()[i]) - static_cast<double>(slow.data()[i]));
    EXPECT_LT(apart, 0.05 * volume);
    EXPECT_LE(test::steepest_over_deg(u, soil, 1.0), 0.1);
}

class SettleSeeds : public testing::TestWithParam<unsigned> {};

TEST_P(SettleSeeds, RoughGroundOfRoughSoilComesToRestOnGridsOfAnyShape) {
    const int width = 33 + static_cast<int>(GetParam()) * 7;
    const int height = 21 + static_cast<int>(GetParam()) * 5;
    const Heightfield base{test::rough_heights(width, height, 3.0F, GetParam()), 0.5};
    SoilTile soil = test::two_soils(1, 0, 0);
    soil.repose = test::rough_heights(width, height, 0.9F, GetParam() + 100);
    soil.tan_repose = soil.repose;
    for (float& tangent : soil.tan_repose)
        tangent = std::tan(tangent);
    soil.diffusion = FloatRaster(width, height, 0.2F);
    FloatRaster u = test::rough_heights(width, height, 4.0F, GetParam() + 200);
    const double before = test::sum_of(u);
    settle_to_rest(u, base, soil, {.keep_base = false});
    FloatRaster total = base.heights;
    for (std::size_t i = 0; i < total.size(); ++i)
        total.data()[i] += u.data()[i];
    EXPECT_LE(test::steepest_over_deg(total, soil, 0.5), 0.1);
    EXPECT_NEAR(test::sum_of(u), before, 1e-6 * before);
}
INSTANTIATE_TEST_SUITE_P(Seeds, SettleSeeds, testing::Range(0U, 5U));

TEST(Settle, KeepsGroundAtRestToTheBit) {
    const Heightfield base{test::rough_heights(50, 40, 20.0F, 3), 0.1};  // far steeper than repose
    FloatRaster u(50, 40);
    const SettleReport report = settle_to_rest(u, base, SoilField(kSand));
    EXPECT_EQ(u, FloatRaster(50, 40));
    EXPECT_EQ(report.excess_before, 0.0);
    EXPECT_EQ(report.cycles, 0);
}

TEST(Settle, LeavesWhatIsFarFromAPileAlone) {
    const Heightfield base = flat(96, 96);
    FloatRaster u = test::cone(96, 6, 3.0);
    settle_to_rest(u, base, SoilField(kSand));
    for (int i = 0; i < 96; ++i)
        EXPECT_EQ(u(i, 2), 0.0F);
}

TEST(Settle, MakesThingsFlatWhereNothingHolds) {
    const Heightfield base = flat(16, 24);
    FloatRaster u = test::rough_heights(16, 24, 1.0F, 5);
    const double mean = test::sum_of(u) / (16 * 24);
    settle_to_rest(u, base, SoilField({.repose_deg = 0}));
    for (const float value : u)
        EXPECT_NEAR(value, mean, 0.002);
}

TEST(Settle, GivesTheSameBytesForAnyNumberOfThreads) {
    const Heightfield base = flat(150, 131);
    const FloatRaster start = test::rough_heights(150, 131, 9.0F, 8);
    const auto run = [&](int n_threads) {
        const ThreadLimit limit(n_threads);
        FloatRaster u = start;
        settle_to_rest(u, base, SoilField(kSand));
        return u;
    };
    EXPECT_EQ(run(1), run(4));
}

TEST(Settle, MirrorsWithTheGroundUpToTheSolversOrder) {
    const Heightfield base = flat(64, 64);
    const SoilTile soil = test::two_soils(64, 34, 34);
    FloatRaster u = test::cone(64, 12, 2.0);
    settle_to_rest(u, base, soil);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_NEAR(u(x, y), u(63 - x, y), 0.25);
}

TEST(SettleErrors, NameTheThing) {
    using testing::HasSubstr;
    using testing::ThrowsMessage;
    const Heightfield base = flat(8, 8);
    FloatRaster u(8, 7);
    EXPECT_THAT([&] { settle_to_rest(u, base, SoilField(kSand)); },
                ThrowsMessage<InvalidInput>(HasSubstr("8 x 7 cells, its base 8 x 8")));
    u = FloatRaster(8, 8);
    u(3, 4) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT([&] { settle_to_rest(u, base, SoilField(kSand)); },
                ThrowsMessage<InvalidInput>(HasSubstr("cell (3, 4)")));
    u(3, 4) = 0;
    SoilTile soil = test::two_soils(8, 30, 30);
    soil.tan_repose(1, 2) = -1;
    EXPECT_THAT([&] { settle_to_rest(u, base, soil); },
                ThrowsMessage<InvalidInput>(HasSubstr("tan_repose of cell (1, 2) is -1")));
    EXPECT_THAT([&] { settle_to_rest(u, base, SoilField(kSand), {.relaxation = 2.5}); },
                ThrowsMessage<InvalidOption>(HasSubstr("relaxation is 2.5")));
}

}  // namespace
}  // namespace scree::terrain
