#include "terrain/grid/sound_step.h"

#include "base/error.h"
#include "ground_fixtures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

struct Scene {
    Heightfield ground;
    SoilField field{kSand};
    DeformerOptions options{.keep_base = false};

    FloatRaster after(int iterations, std::span<const Load> loads = {}) const {
        const SoilTile soil = test::soil_of(field, ground);
        const SoundRule rule = sound_rule(ground, options);
        FloatRaster u = test::zeros_like(ground);
        for (int i = 0; i < iterations; ++i)
            u = sound_step(ground, soil, loads, u, rule).displacement;
        return u;
    }

    FloatRaster heights_after(int iterations) const {
        FloatRaster u = after(iterations);
        for (std::size_t i = 0; i < u.size(); ++i)
            u.data()[i] += ground.heights.data()[i];
        return u;
    }
};

double steepest_deg(const FloatRaster& heights) {
    float steepest = 0.0F;
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x) {
            if (x > 0)
                steepest = std::max(steepest, std::fabs(heights(x, y) - heights(x - 1, y)));
            if (y > 0)
                steepest = std::max(steepest, std::fabs(heights(x, y) - heights(x, y - 1)));
        }
    return std::atan(double{steepest}) * 180.0 / std::numbers::pi;
}

TEST(SoundStep, ExcessMovesTheSlopeAboveReposeThroughEachFace) {
    Scene scene{.ground = test::flat_ground(7, 7)};
    scene.ground.heights(3, 3) = 2.0F;
    const FloatRaster u = scene.after(1);
    const double flux = 0.2 * (2.0 - std::tan(34.0 * std::numbers::pi / 180.0));
    EXPECT_NEAR(u(3, 3), -4 * flux, 3e-5);  // quanta are 2^-18
    EXPECT_NEAR(u(4, 3), flux, 1e-5);
    EXPECT_NEAR(u(3, 2), flux, 1e-5);
    EXPECT_EQ(u(4, 4), 0.0F);
}

TEST(SoundStep, WeightAndGainScaleTheSlopeByItsAngle) {
    Scene scene{.ground = test::flat_ground(7, 7)};
    scene.ground.heights(3, 3) = 2.0F;
    const double repose = 34.0 * std::numbers::pi / 180.0;
    const double weight = (std::atan(2.0) - repose) / (std::numbers::pi / 2 - repose);
    scene.options.slide = Slide::Weight;
    EXPECT_NEAR(scene.after(1)(4, 3), 0.2 * weight * 2.0, 1e-5);
    scene.options.slide = Slide::Gain;
    EXPECT_NEAR(scene.after(1)(4, 3), 0.2 * 2.0, 1e-5);  // four times the weight, at most 1
}

TEST(SoundStep, TheHigherCellsReposeCounts) {
    DescriptionMap map = test::patchwork(6, 3, 1);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 6; ++x)
            map.ids(x, y) = x < 3 ? 0 : 1;  // sand, mud
    map.materials[1].soil.diffusion = 0.2;
    for (const bool sand_is_higher : {true, false}) {
        Scene scene{.ground = test::flat_ground(6, 3), .field = SoilField(map, 1.0)};
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 6; ++x)
                scene.ground.heights(x, y) = (x < 3) == sand_is_higher ? 0.5F : 0.0F;
        // 27 degrees: sand holds at 34, mud does not at 15.
        EXPECT_EQ(scene.after(1)(3, 1) != 0.0F, !sand_is_higher);
    }
}

TEST(SoundStep, FacesTakeTheHarmonicMeanOfDiffusion) {
    DescriptionMap map = test::patchwork(4, 2, 1);
    for (int x = 0; x < 4; ++x)
        map.ids(x, 0) = map.ids(x, 1) = x < 2 ? 0 : 1;
    map.materials[1].soil.diffusion = 0.0;
    Scene scene{.ground = test::flat_ground(4, 2), .field = SoilField(map, 1.0)};
    for (int y = 0; y < 2; ++y)
        scene.ground.heights(0, y) = scene.ground.heights(1, y) = 9.0F;
    EXPECT_EQ(scene.after(5), test::zeros_like(scene.ground));  // nothing enters concrete
}

TEST(SoundStep, PushGoesWithTheForceAndIsLimitedByThePenetration) {
    Scene scene{.ground = test::flat_ground(9, 9), .field = SoilField({.diffusion = 0.0})};
    Load load{.window = {4, 4, 1, 1},
              .force_x = FloatRaster(1, 1, 1.0F),
              .force_z = FloatRaster(1, 1),
              .underside = FloatRaster(1, 1, -1.0F)};
    const FloatRaster free = scene.after(1, {&load, 1});
    // Mobility 1/2, and the force is averaged over the face with a cell without any. The cell
    // behind would push into the loaded one, but has no soil above an underside to give.
    EXPECT_NEAR(free(5, 4), 0.25, 1e-5);
    EXPECT_NEAR(free(4, 4), -0.25, 1e-5);
    EXPECT_EQ(free(3, 4), 0.0F);
    load.underside(0, 0) = -0.1F;
    const FloatRaster limited = scene.after(3, {&load, 1});
    EXPECT_NEAR(limited(5, 4), 0.1, 1e-5);
    EXPECT_GE(limited(4, 4), -0.1F);
}

TEST(SoundStep, ABallDigsToItsUndersideAndRaisesARim) {
    Scene scene{.ground = test::flat_ground(40, 31)};
    scene.options.keep_base = true;
    const SoilTile soil = test::soil_of(scene.field, scene.ground);
    const SoundRule rule = sound_rule(scene.ground, scene.options);
    FloatRaster u = test::zeros_like(scene.ground);
    for (int frame = 0; frame < 24; ++frame) {
        const Load load = test::ball(12 + 0.5 * frame, 15, 6, -2.0, 0.5F, 0.5F);
        for (int i = 0; i < 4; ++i)
            u = sound_step(scene.ground, soil, {&load, 1}, u, rule).displacement;
    }
    EXPECT_GE(*std::min_element(u.begin(), u.end()), -2.0F - 1e-5F);
    EXPECT_LT(u(20, 15), -1.5F);              // the groove
    EXPECT_GT(u(30, 15), 0.3F);               // heaped up in front
    EXPECT_GT(u(20, 15 + 8), 0.1F);           // and at the side
    EXPECT_EQ(u(20, 15 + 8), u(20, 15 - 8));  // the same on both
    EXPECT_EQ(test::sum_of(u), 0.0);
}

TEST(SoundStep, CompactionTakesItsShareOfThePenetrationAndReportsIt) {
    Scene scene{.ground = test::flat_ground(9, 9, 0.5),
                .field = SoilField({.mobility = 0.5, .compaction = 0.4})};
    const SoilTile soil = test::soil_of(scene.field, scene.ground);
    Load load{.window = {4, 4, 1, 1},
              .force_x = FloatRaster(1, 1),
              .force_z = FloatRaster(1, 1),
              .underside = FloatRaster(1, 1, -1.0F)};
    const SoundStep step =
        sound_step(scene.ground, soil, {&load, 1}, test::zeros_like(scene.ground),
                   sound_rule(scene.ground, scene.options));
    EXPECT_NEAR(step.displacement(4, 4), -0.2, 1e-5);
    EXPECT_NEAR(step.compacted_m3, 0.2 * 0.25, 1e-5);
    EXPECT_EQ(step.compacted_m3, -test::sum_of(step.displacement) * 0.25);
}

class SoundForms : public testing::TestWithParam<Slide> {
protected:
    DeformerOptions options() const {
        return {.slide = GetParam(),
                .time_step = GetParam() == Slide::Gain ? 0.625 : 1.25,
                .keep_base = false};
    }
};

TEST_P(SoundForms, KeepVolumeExactlyAndObeyTheMaximumPrinciple) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene{.ground = test::rough_ground(33, 21, 15.0, seed), .options = options()};
        const FloatRaster u = scene.after(200);
        EXPECT_EQ(test::sum_of(u), 0.0);  // every volume is a whole number of quanta
        const FloatRaster heights = scene.heights_after(200);
        const auto [low, high] =
            std::minmax_element(scene.ground.heights.begin(), scene.ground.heights.end());
        EXPECT_GE(*std::min_element(heights.begin(), heights.end()), *low);
        EXPECT_LE(*std::max_element(heights.begin(), heights.end()), *high);
        EXPECT_LT(steepest_deg(heights), steepest_deg(scene.ground.heights));
    }
}

TEST_P(SoundForms, MirrorAndTurnWithTheGround) {
    const Scene scene{.ground = test::rough_ground(17, 17, 12.0, 4), .options = options()};
    const FloatRaster u = scene.after(20);
    const auto moved = [&](const std::function<float(const FloatRaster&, int, int)>& at) {
        Scene other = scene;
        for (int y = 0; y < 17; ++y)
            for (int x = 0; x < 17; ++x)
                other.ground.heights(x, y) = at(scene.ground.heights, x, y);
        const FloatRaster got = other.after(20);
        FloatRaster expected = got;
        for (int y = 0; y < 17; ++y)
            for (int x = 0; x < 17; ++x)
                expected(x, y) = at(u, x, y);
        EXPECT_EQ(got, expected);
    };
    moved([](const FloatRaster& r, int x, int y) { return r(16 - x, y); });
    moved([](const FloatRaster& r, int x, int y) { return r(x, 16 - y); });
    moved([](const FloatRaster& r, int x, int y) { return r(y, 16 - x); });
}

TEST_P(SoundForms, ConesSettleAtRepose) {
    // 60 degrees, radius 8; within the steps that the form needs at this size.
    Scene scene{.ground = test::cone(31, 8, std::sqrt(3.0)),
                .field = SoilField({.repose_deg = 30, .diffusion = 0.2}),
                .options = options()};
    const FloatRaster heights = scene.heights_after(GetParam() == Slide::Excess ? 600 : 2500);
    EXPECT_LT(steepest_deg(heights), 30.5);
    EXPECT_GT(steepest_deg(heights), 29.0);
}

INSTANTIATE_TEST_SUITE_P(Slides, SoundForms,
                         testing::Values(Slide::Excess, Slide::Weight, Slide::Gain),
                         [](const auto& param) {
                             return std::string(kSlideNames[static_cast<std::size_t>(param.param)]);
                         });

TEST(SoundStep, DivergesBeyondTheBoundAndNotAtIt) {
    // A checkerboard on soil without repose is what the bound is about.
    const auto largest = [](double step) {
        Scene scene{.ground = test::flat_ground(16, 16),
                    .field = SoilField({.repose_deg = 0, .diffusion = step})};
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                scene.ground.heights(x, y) = (x + y) % 2 == 0 ? 1.0F : -1.0F;
        float result = 0.0F;
        for (const float height : scene.heights_after(60))
            result = std::max(result, std::fabs(height));
        return result;
    };
    EXPECT_LE(largest(0.25), 1.0F);
    EXPECT_GT(largest(0.30), 1000.0F);
}

TEST(SoundStep, ZeroBorderHoldsTheRim) {
    Scene scene{.ground = test::rough_ground(12, 9, 10.0, 1)};
    scene.options.border = Border::Zero;
    const FloatRaster u = scene.after(30);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 12; ++x)
            if (x == 0 || y == 0 || x == 11 || y == 8) {
                EXPECT_EQ(u(x, y), 0.0F);
            }
    EXPECT_NE(test::sum_of(u), 0.0);  // the rim swallows
}

TEST(SoundStepErrors, LoadsNameWhatIsWrong) {
    Load load = test::ball(5, 5, 3, 0, 1.0F, 0.0F);
    check_load(load);
    load.force_x(1, 2) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT([&] { check_load(load); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("cell (2, 3)")));
    load = test::ball(5, 5, 3, 0, 1.0F, 0.0F);
    load.underside = FloatRaster(2, 2);
    EXPECT_THAT([&] { check_load(load); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("2 x 2 cells")));
    load = test::ball(5, 5, 3, 0, 1.0F, 0.0F);
    load.window.x = std::numeric_limits<int>::min();
    EXPECT_THROW(check_load(load), InvalidInput);
    load = test::ball(5, 5, 3, 0, 1.0F, 0.0F);
    load.underside(3, 3) = -std::numeric_limits<float>::infinity();
    EXPECT_THROW(check_load(load), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
