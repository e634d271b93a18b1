#include "terrain/grid/literal_step.h"

#include "ground_fixtures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

constexpr double kSandRepose = 34.0 * std::numbers::pi / 180.0;

// The weight (4.4) of a term, by (4.11), in double.
double weight(double term) {
    return (std::atan(std::sqrt(std::fabs(term))) - kSandRepose) /
           (std::numbers::pi / 2 - kSandRepose);
}

struct Scene {
    Heightfield ground = test::flat_ground(9, 9);
    SoilTile soil = test::soil_of(SoilField(kSand), ground);
    LiteralRule rule;

    FloatRaster step(std::span<const Load> loads = {}) const {
        return literal_step(ground.heights, soil, loads, ground.heights, rule);
    }
};

TEST(LiteralStep, IsTheEquationForASpike) {
    Scene scene;
    scene.ground.heights(4, 4) = 10.0F;
    const FloatRaster next = scene.step();
    const double middle = 0.2 * -20.0;  // D times the second difference
    EXPECT_NEAR(next(4, 4), 10.0 + 2 * weight(middle) * middle, 1e-5);
    const double beside = 0.2 * 10.0;
    EXPECT_NEAR(next(5, 4), weight(beside) * beside, 1e-5);
    EXPECT_NEAR(next(4, 3), weight(beside) * beside, 1e-5);
    EXPECT_EQ(next(5, 5), 0.0F);
}

TEST(LiteralStep, TurnsDiffusionRoundBelowReposeUnlessClamped) {
    Scene scene;
    scene.ground.heights(4, 4) = 0.5F;
    EXPECT_GT(scene.step()(4, 4), 0.5F);
    scene.rule.clamp_weights = true;
    EXPECT_EQ(scene.step()(4, 4), 0.5F);
}

TEST(LiteralStep, ChangesWithTheSignAndTheHalfOfTheForceTerm) {
    Scene scene;
    Load load{.window = {4, 4, 1, 1},
              .force_x = FloatRaster(1, 1, 8.0F),
              .force_z = FloatRaster(1, 1),
              .underside = FloatRaster(1, 1, -1.0F)};
    const double term = 0.5 * kSand.mobility * 8.0;
    const auto next = [&] { return scene.step({&load, 1}); };
    EXPECT_NEAR(next()(5, 4), term * weight(term), 1e-5);  // heaps in front, digs behind
    EXPECT_NEAR(next()(3, 4), -term * weight(term), 1e-5);
    scene.rule.plus_sign = true;  // as printed: the other way round
    EXPECT_NEAR(next()(5, 4), -term * weight(term), 1e-5);
    EXPECT_NEAR(next()(3, 4), term * weight(term), 1e-5);
    scene.rule.plus_sign = false;
    scene.rule.half = false;  // the listing's form is twice the mobility
    EXPECT_NEAR(next()(5, 4), 2 * term * weight(2 * term), 1e-5);
    scene.rule.half = true;
    scene.rule.steps = 2.0F;
    EXPECT_NEAR(next()(5, 4), term * weight(4 * term), 1e-5);
}

TEST(LiteralStep, AnOutwardForceDigsAndRaisesARim) {
    Scene scene;
    scene.ground = test::flat_ground(41, 41);
    scene.soil = test::soil_of(SoilField(kSand), scene.ground);
    scene.rule.clamp_weights = true;
    const Load load = test::ball(20, 20, 8, -1.0, 0.0F, 10.0F);
    const FloatRaster next = scene.step({&load, 1});
    EXPECT_LT(next(20, 20), -0.1F);
    EXPECT_GT(next(29, 20), 0.1F);
    scene.rule.plus_sign = true;
    const FloatRaster printed = scene.step({&load, 1});
    EXPECT_GT(printed(20, 20), 0.1F);
    EXPECT_LT(printed(29, 20), -0.1F);
}

TEST(LiteralStep, ChainRuleMattersAtABorderOfMaterialsAlone) {
    Scene scene;
    scene.ground = test::rough_ground(24, 12, 20, 5);
    const Load load = test::ball(12, 6, 4, -1.0, 2.0F, 3.0F);
    const auto both = [&] {
        LiteralRule chain = scene.rule;
        chain.terms = LiteralTerms::ChainRule;
        return std::pair(scene.step({&load, 1}),
                         literal_step(scene.ground.heights, scene.soil, {&load, 1},
                                      scene.ground.heights, chain));
    };
    scene.soil = test::soil_of(SoilField(kSand), scene.ground);
    const auto [single, chain] = both();
    EXPECT_EQ(single, chain);

    DescriptionMap map = test::patchwork(24, 12, 1);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 24; ++x)
            map.ids(x, y) = x < 12 ? 0 : 2;
    scene.soil = test::soil_of(SoilField(map, 1.0), scene.ground);
    const auto [single_two, chain_two] = both();
    for (int y = 1; y < 11; ++y)
        for (int x = 0; x < 24; ++x)
            if (x != 12) {  // there the terms differ only where a force acts
                EXPECT_EQ(single_two(x, y) != chain_two(x, y), x == 11) << x << ' ' << y;
            }
}

TEST(LiteralStep, ASteepConeNeverSlides) {
    Heightfield ground = test::cone(61, 20, std::tan(std::numbers::pi / 3));
    const SoilTile soil = test::soil_of(SoilField({.repose_deg = 30}), ground);
    LiteralRule rule;
    rule.clamp_weights = true;
    FloatRaster heights = ground.heights;
    for (int i = 0; i < 200; ++i)
        heights = literal_step(ground.heights, soil, {}, heights, rule);
    // Half way up its flanks it is as steep as before, though repose is 30 degrees.
    EXPECT_NEAR(heights(40, 30) - heights(41, 30), std::sqrt(3.0), 0.02);
    EXPECT_LT(heights(30, 30), ground.heights(30, 30) - 0.5F);  // the tip alone rounds off
}

TEST(LiteralStep, DoesNotKeepVolume) {
    const Heightfield ground = test::cone(41, 12, 2.0);
    Heightfield rough = ground;
    Rng rng({.seed = 3});
    for (float& height : rough.heights)
        if (height > 0.0F)
            height += static_cast<float>(rng.uniform(0.0, 6.0));
    const SoilTile soil = test::soil_of(SoilField({.repose_deg = 30}), rough);
    FloatRaster heights = rough.heights;
    for (int i = 0; i < 50; ++i)
        heights = literal_step(ground.heights, soil, {}, heights, {.clamp_weights = true});
    const double drift = test::sum_of(heights) / test::sum_of(rough.heights) - 1.0;
    RecordProperty("relative_drift", std::to_string(drift));
    EXPECT_GT(std::fabs(drift), 1e-3);
}

TEST(LiteralStep, StaleHalosOfGroupsChangeTheResult) {
    const Heightfield ground = test::flat_ground(48, 48);
    const SoilTile soil = test::soil_of(SoilField(kSand), ground);
    const Load load = test::ball(16, 16, 6, -1.0, 4.0F, 4.0F);
    const LiteralRule rule{.clamp_weights = true};
    std::vector<double> errors;
    for (const int iterations : {1, 3, 5}) {
        FloatRaster whole = ground.heights;
        FloatRaster grouped = ground.heights;
        for (int frame = 0; frame < 10; ++frame) {
            for (int i = 0; i < iterations; ++i)
                whole = literal_step(ground.heights, soil, {&load, 1}, whole, rule);
            grouped =
                literal_step_tiled(ground.heights, soil, {&load, 1}, grouped, rule, iterations);
        }
        double error = 0.0;
        for (std::size_t i = 0; i < whole.size(); ++i)
            error = std::max(error, std::fabs(double{whole.data()[i]} - grouped.data()[i]));
        errors.push_back(error / *std::max_element(whole.begin(), whole.end()));
    }
    RecordProperty("error_of_peak_3", std::to_string(errors[1]));
    RecordProperty("error_of_peak_5", std::to_string(errors[2]));
    EXPECT_EQ(errors[0], 0.0);
    EXPECT_GT(errors[1], 0.005);
    EXPECT_GT(errors[2], errors[1]);
}

class LiteralGround : public testing::TestWithParam<bool> {};

TEST_P(LiteralGround, GivesThePlainStepsBytes) {
    const Heightfield ground = test::rough_ground(70, 45, 12, 3, 0.1, 0.5);
    const bool patchwork = GetParam();
    const SoilField field =
        patchwork ? SoilField(test::patchwork(70, 45, 3), 0.5) : SoilField(kPebbles);
    const SoilTile soil = test::soil_of(field, ground);
    const Load load = test::ball(2, 20, 7, -1.0, 0.5F, 2.0F, 0.5);
    for (const Border border : {Border::NoFlux, Border::Zero})
        for (const LiteralTerms terms : {LiteralTerms::SingleTerm, LiteralTerms::ChainRule}) {
            const DeformerOptions options{.reading = Reading::Literal,
                                          .border = border,
                                          .iterations = 3,
                                          .time_step = 0.5,
                                          .terms = terms,
                                          .clamp_weights = patchwork};
            Deformer deformer(ground, field, options);
            deformer.step({});
            deformer.step({&load, 1});
            FloatRaster heights = ground.heights;
            for (int i = 0; i < 6; ++i)
                heights = literal_step(ground.heights, soil,
                                       i < 3 ? std::span<const Load>{} : std::span(&load, 1),
                                       heights, literal_rule(ground, options));
            for (std::size_t i = 0; i < heights.size(); ++i)
                heights.data()[i] -= ground.heights.data()[i];
            EXPECT_EQ(deformer.displacement(deformer.extent()), heights);
            EXPECT_NEAR(deformer.displaced_volume(), test::sum_of(heights) * 0.25, 1e-3);
        }
}
INSTANTIATE_TEST_SUITE_P(Soils, LiteralGround, testing::Bool());

}  // namespace
}  // namespace scree::terrain
