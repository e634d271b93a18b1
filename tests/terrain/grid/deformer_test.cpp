#include "terrain/grid/deformer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "ground_fixtures.h"
#include "terrain/grid/sound_step.h"

#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Two loads that overlap, one that hangs over the rim and one outside of the ground.
std::vector<Load> loads_at(double x) {
    return {test::ball(x, 60, 9, -0.5, 0.4F, 0.3F), test::ball(x + 8, 66, 5, -1.0, -0.2F, 0.5F),
            test::ball(2, 1, 6, -2.0, -0.5F, 0.2F), test::ball(-40, -40, 3, -1.0, 1.0F, 1.0F)};
}

/// The plain step, frame by frame.
FloatRaster plain_frames(const Heightfield& ground, const SoilField& field,
                         const DeformerOptions& options, int frames, double* compacted) {
    const SoilTile soil = test::soil_of(field, ground);
    const SoundRule rule = sound_rule(ground, options);
    FloatRaster u = test::zeros_like(ground);
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<Load> loads =
            frame < frames - 1 ? loads_at(120 + 3 * frame) : std::vector<Load>{};
        for (int i = 0; i < options.iterations; ++i) {
            SoundStep step = sound_step(ground, soil, loads, u, rule);
            u = std::move(step.displacement);
            *compacted += step.compacted_m3;
        }
    }
    return u;
}

FloatRaster tiled_frames(const Heightfield& ground, const SoilField& field,
                         const DeformerOptions& options, int frames, double* compacted) {
    Deformer deformer(ground, field, options);
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<Load> loads =
            frame < frames - 1 ? loads_at(120 + 3 * frame) : std::vector<Load>{};
        *compacted += deformer.step(loads).compacted_m3;
    }
    return deformer.displacement(deformer.extent());
}

struct Case {
    Slide slide;
    Border border;
    bool keep_base;
    bool patchwork;
    int iterations;
    int width = 140;
    int height = 150;
};

class TiledEqualsPlain : public testing::TestWithParam<Case> {};

TEST_P(TiledEqualsPlain, ToTheLastBit) {
    const Case& c = GetParam();
    const Heightfield ground = test::rough_ground(c.width, c.height, 1.5, 7, 0.05);
    const SoilField field =
        c.patchwork ? SoilField(test::patchwork(c.width, c.height, 3), 1.0) : SoilField(kSand);
    const DeformerOptions options{.slide = c.slide,
                                  .border = c.border,
                                  .iterations = c.iterations,
                                  .time_step = c.slide == Slide::Gain ? 0.6 : 1.2,
                                  .keep_base = c.keep_base};
    double plain_compacted = 0.0;
    double tiled_compacted = 0.0;
    const FloatRaster plain = plain_frames(ground, field, options, 4, &plain_compacted);
    const FloatRaster tiled = tiled_frames(ground, field, options, 4, &tiled_compacted);
    EXPECT_EQ(plain, tiled);
    EXPECT_NEAR(plain_compacted, tiled_compacted, 1e-9);
    EXPECT_EQ(plain_compacted > 0.0, c.patchwork);
}

INSTANTIATE_TEST_SUITE_P(Options, TiledEqualsPlain,
                         testing::Values(Case{Slide::Excess, Border::NoFlux, true, false, 4},
                                         Case{Slide::Excess, Border::NoFlux, false, false, 1, 384, 384},
                                         Case{Slide::Excess, Border::Zero, false, true, 9},
                                         Case{Slide::Excess, Border::NoFlux, true, true, 5},
                                         Case{Slide::Weight, Border::Zero, true, false, 3},
                                         Case{Slide::Weight, Border::NoFlux, false, true, 6, 260, 30},
                                         Case{Slide::Gain, Border::NoFlux, true, true, 4}));

}  // namespace
}  // namespace scree::terrain
