#include "terrain/grid/implicit_step.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/grid/sound_step.h"
#include "tests/support/sand_piles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

constexpr Slide kSlides[] = {Slide::Excess, Slide::Weight, Slide::Gain};

double furthest_apart(const FloatRaster& a, const FloatRaster& b) {
    double apart = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        apart = std::max(
            apart, std::abs(static_cast<double>(a.data()[i]) - static_cast<double>(b.data()[i])));
    return apart;
}

TEST(ImplicitStep, AgreesWithTheExplicitSchemeAtSmallStepsToFirstOrder) {
    const Heightfield base{FloatRaster(32, 32), 1.0};
    const SoilTile soil = test::two_soils(32, 30, 40, 0.2F);
    const FloatRaster start = test::cone(32, 9, 2.0);
    for (const Slide slide : kSlides) {
        const auto apart = [&](double time_step, int steps) {
            const SoundRule rule = sound_rule(base, {.slide = slide, .time_step = time_step});
            FloatRaster slow = start;
            FloatRaster fast = start;
            for (int i = 0; i < steps; ++i) {
                slow = sound_step(base, soil, {}, slow, rule).displacement;
                implicit_step(fast, base, soil, {.slide = slide, .time_step = time_step});
            }
            EXPECT_GT(furthest_apart(slow, start), 0.3);
            return furthest_apart(slow, fast);
        };
        const double coarse = apart(0.2, 10);
        const double fine = apart(0.05, 40);
        EXPECT_LT(coarse, 0.12) << names_of(slide)[static_cast<std::size_t>(slide)];
        EXPECT_LT(fine, 0.35 * coarse) << names_of(slide)[static_cast<std::size_t>(slide)];
    }
}

TEST(ImplicitStep, IsStableAtTenTimesTheExplicitBoundAndFarBeyond) {
    const Heightfield base{FloatRaster(24, 31), 0.5};
    const SoilField soil(Soil{.repose_deg = 30, .diffusion = 0.25});
    const FloatRaster start = test::rough_heights(24, 31, 40.0F, 2);
    const auto [least, greatest] = std::minmax_element(start.begin(), start.end());
    for (const Slide slide : kSlides)
        for (const double time_step : {10.0, 100.0}) {
            FloatRaster u = start;
            for (int i = 0; i < 3; ++i) {
                const ImplicitReport report =
                    implicit_step(u, base, soil, {.slide = slide, .time_step = time_step});
                EXPECT_TRUE(report.converged);
                for (const float value : u) {  // maximum principle
                    EXPECT_GE(value, *least - 1e-3F);
                    EXPECT_LE(value, *greatest + 1e-3F);
                }
            }
            EXPECT_NEAR(test::sum_of(u), test::sum_of(start), 1e-6 * test::sum_of(start));
        }
}

TEST(ImplicitStep, TheExplicitSchemeIsNotStableThere) {
    const SoilTile soil = test::two_soils(31, 30, 30);
    const Heightfield square{FloatRaster(31, 31), 0.5};
    const SoundRule rule = sound_rule(square, {.time_step = 10});
    FloatRaster u = test::rough_heights(31, 31, 40.0F, 2);
    for (int i = 0; i < 3; ++i)
        u = sound_step(square, soil, {}, u, rule).displacement;
    EXPECT_GT(*std::max_element(u.begin(), u.end()), 1000.0F);
}

TEST(ImplicitStep, LeavesTheGroundAsItWasWhereItDidNotConverge) {
    const Heightfield base{FloatRaster(40, 40), 1.0};
    const FloatRaster start = test::cone(40, 15, 2.0);
    FloatRaster u = start;
    const ImplicitReport report =
        implicit_step(u, base, SoilField(kSand), {.time_step = 100, .max_sweeps = 3});
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.sweeps, 3);
    EXPECT_EQ(u, start);
}

TEST(ImplicitStep, NeedsFewPassesForAHundredExplicitSteps) {
    const Heightfield base{FloatRaster(64, 64), 1.0};
    const SoilField soil(Soil{.repose_deg = 30, .diffusion = 0.25});
    FloatRaster u = test::cone(64, 16, 2.0);
    EXPECT_LT(implicit_step(u, base, soil, {.time_step = 10}).sweeps, 40);
    EXPECT_LT(implicit_step(u, base, soil, {.time_step = 100}).sweeps, 120);
}

TEST(ImplicitStep, SolvesTwoCellsAsTheClosedFormSays) {
    // Difference d after the step: d + 2 k (d - t) = D for the excess slide; of both rows alike.
    Heightfield base{FloatRaster(2, 2), 1.0};
    FloatRaster u(2, 2);
    u(1, 0) = u(1, 1) = 5.0F;
    const double t = std::tan(34 * std::numbers::pi / 180);
    const double k = 0.2 * 10;
    implicit_step(u, base, SoilField(kSand), {.tolerance = 1e-8});
    const double d = (5.0 + 2 * k * t) / (1 + 2 * k);
    for (int y = 0; y < 2; ++y) {
        EXPECT_NEAR(u(0, y), 2.5 - d / 2, 1e-5);
        EXPECT_NEAR(u(1, y), 2.5 + d / 2, 1e-5);
    }
}

TEST(ImplicitStep, SoilWithoutDiffusionStays) {
    const Heightfield base{FloatRaster(32, 32), 1.0};
    SoilTile soil = test::two_soils(32, 30, 30);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 16; ++x)
            soil.diffusion(x, y) = 0.0F;
    const FloatRaster start = test::cone(32, 10, 2.0);
    FloatRaster u = start;
    implicit_step(u, base, soil);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(u(x, y), start(x, y));
    EXPECT_NE(u, start);
}

TEST(ImplicitStep, GivesTheSameBytesForAnyNumberOfThreads) {
    const Heightfield base{FloatRaster(70, 90), 1.0};
    const FloatRaster start = test::rough_heights(70, 90, 9.0F, 8);
    const auto run = [&](int n_threads) {
        const ThreadLimit limit(n_threads);
        FloatRaster u = start;
        implicit_step(u, base, SoilField(kSand), {.slide = Slide::Weight, .max_sweeps = 20});
        return u;
    };
    EXPECT_EQ(run(1), run(4));
}

TEST(ImplicitStepErrors, NameTheOption) {
    const Heightfield base{FloatRaster(8, 8), 1.0};
    FloatRaster u(8, 8);
    EXPECT_THAT([&] { implicit_step(u, base, SoilField(kSand), {.time_step = -1}); },
                testing::ThrowsMessage<InvalidOption>(testing::HasSubstr("time-step is -1")));
}

}  // namespace
}  // namespace scree::terrain
