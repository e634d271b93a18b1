#include "terrain/grid/face_flux.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

constexpr float kQuantum = 1.0F / 1024;

// Never above the amount, which keeps the maximum principle, and less than two quanta below.
void expect_rounded_down(float quanta, double amount) {
    EXPECT_EQ(quanta / kQuantum, std::round(quanta / kQuantum));
    EXPECT_GE(quanta, 0.0F);
    EXPECT_LE(quanta, std::max(amount, 0.0) + 1e-6);
    EXPECT_GT(quanta, amount - 2.0 * kQuantum - 1e-6);
}

TEST(FaceFlux, QuantisedRoundsDown) {
    Rng rng({.seed = 1});
    for (int i = 0; i < 2000; ++i) {
        const auto amount = static_cast<float>(rng.uniform() - 0.2);
        expect_rounded_down(quantised(amount, kQuantum), amount);
    }
    EXPECT_EQ(quantised(5 * kQuantum, kQuantum) + quantised(-1.0F, kQuantum), 4 * kQuantum);
}

TEST(FaceFlux, ExcessIsRoundedDownForAnySlopeAndSoil) {
    Rng rng({.seed = 2});
    for (int i = 0; i < 2000; ++i) {
        const auto difference = static_cast<float>(4.0 * rng.uniform() - 2.0);
        const auto holds = static_cast<float>(2.0 * rng.uniform());
        const auto diffusion = static_cast<float>(0.25 * rng.uniform());
        const double amount = (std::fabs(double{difference}) - holds) * diffusion;
        expect_rounded_down(excess_slide(difference, holds, diffusion, kQuantum), amount);
        EXPECT_EQ(excess_slide(difference, holds, diffusion, kQuantum),
                  excess_slide(-difference, holds, diffusion, kQuantum));
    }
}

TEST(FaceFlux, NothingSlidesBelowWhatHolds) {
    Rng rng({.seed = 3});
    for (int i = 0; i < 2000; ++i) {
        const auto holds = static_cast<float>(3.0 * rng.uniform());
        const auto difference = holds * static_cast<float>(rng.uniform());
        EXPECT_EQ(excess_slide(difference, holds, 0.25F, kQuantum), 0.0F);
    }
}

TEST(FaceFlux, ArctangentIsThatOfTheLibrary) {
    for (int i = 0; i <= 4000; ++i) {
        const float tangent = static_cast<float>(i) * 0.005F;
        EXPECT_NEAR(arctangent(tangent), std::atan(double{tangent}), 4e-7);
    }
    EXPECT_NEAR(arctangent(1e30F), std::numbers::pi / 2, 4e-7);
}

TEST(FaceFlux, DiffusionOfAFaceIsTheHarmonicMean) {
    EXPECT_FLOAT_EQ(face_diffusion(0.1F, 0.3F), 0.15F);
    EXPECT_EQ(face_diffusion(0.0F, 0.0F), 0.0F);
    EXPECT_EQ(face_diffusion(0.0F, 0.2F), 0.0F);
}

}  // namespace
}  // namespace scree::terrain
