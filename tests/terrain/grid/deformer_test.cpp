#include "terrain/grid/deformer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "ground_fixtures.h"
#include "terrain/grid/sound_step.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

using testing::AllOf;
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
    const FloatRaster plain = plain_frames(ground, field, options, 3, &plain_compacted);
    const FloatRaster tiled = tiled_frames(ground, field, options, 3, &tiled_compacted);
    EXPECT_EQ(plain, tiled);
    EXPECT_NE(plain, test::zeros_like(ground));
    EXPECT_NEAR(plain_compacted, tiled_compacted, 1e-9);
    EXPECT_EQ(plain_compacted > 0.0, c.patchwork);
}

INSTANTIATE_TEST_SUITE_P(
    Options, TiledEqualsPlain,
    testing::Values(Case{Slide::Excess, Border::NoFlux, true, false, 4},
                    Case{Slide::Excess, Border::NoFlux, false, false, 1, 384, 384},
                    Case{Slide::Excess, Border::Zero, false, true, 9},
                    Case{Slide::Excess, Border::NoFlux, true, true, 5},
                    Case{Slide::Weight, Border::Zero, true, false, 3},
                    Case{Slide::Weight, Border::NoFlux, false, true, 6, 260, 30},
                    Case{Slide::Gain, Border::NoFlux, true, true, 4}));

TEST(Deformer, GivesTheSameBytesForAnyNumberOfThreads) {
    const Heightfield ground = test::rough_ground(400, 300, 3.0, 2);
    const SoilField field(test::patchwork(400, 300, 9), 1.0);
    const DeformerOptions options{.keep_base = false};
    FloatRaster results[2];
    for (const int threads : {1, 4}) {
        const ThreadLimit limit(threads);
        double compacted = 0.0;
        results[threads == 1 ? 0 : 1] = tiled_frames(ground, field, options, 4, &compacted);
    }
    EXPECT_EQ(results[0], results[1]);
}

TEST(Deformer, LeavesAHillyBaseAloneInIdleFrames) {
    const Heightfield ground = test::rough_ground(200, 150, 30.0, 6);  // far steeper than repose
    for (const Slide slide : {Slide::Excess, Slide::Weight}) {
        Deformer deformer(ground, SoilField(kMud), {.slide = slide});
        for (int frame = 0; frame < 3; ++frame) {
            const DeformerReport report = deformer.step({});
            EXPECT_TRUE(report.at_rest);
            EXPECT_EQ(report.tiles_stepped, 0);
        }
        EXPECT_EQ(deformer.displacement(deformer.extent()), test::zeros_like(ground));
        EXPECT_EQ(deformer.heights(deformer.extent()), ground.heights);
    }
}

TEST(Deformer, StepsAndStoresOnlyWhatMoves) {
    const Heightfield ground = test::flat_ground(2048, 2048, 0.1);
    Deformer deformer(ground, SoilField(kSand));
    const std::size_t before = deformer.bytes();
    EXPECT_LT(before, 2048U * 2048U * sizeof(float) / 4);
    const Load load = test::ball(700, 700, 6, -0.2, 0.4F, 0.4F, 0.1);
    const DeformerReport pushed = deformer.step({&load, 1});
    EXPECT_LE(pushed.tiles_stepped, 4);
    EXPECT_FALSE(pushed.at_rest);
    EXPECT_LT(deformer.bytes(), before + (4U << 20));
    const DeformerReport settled = deformer.settle(4000, 0.0);
    EXPECT_TRUE(settled.at_rest);
    EXPECT_EQ(deformer.step({}).tiles_stepped, 0);
    EXPECT_EQ(deformer.displaced_volume(), 0.0);
    EXPECT_EQ(deformer.displacement({1000, 1000, 1, 1})(0, 0), 0.0F);
    EXPECT_LT(deformer.displacement({700, 700, 1, 1})(0, 0), -0.05F);
}

TEST(Deformer, SlidesOnWhenTheLoadLifts) {
    // The wall that a plate holds up gives way as soon as it is gone.
    const Heightfield ground = test::flat_ground(60, 60);
    Deformer deformer(ground, SoilField(kSand));
    const Load load = test::ball(30, 30, 12, -4.0, 0.0F, 1.0F);
    for (int frame = 0; frame < 30; ++frame)
        deformer.step({&load, 1});
    const FloatRaster held = deformer.displacement(deformer.extent());
    EXPECT_FALSE(deformer.step({}).at_rest);
    EXPECT_NE(deformer.displacement(deformer.extent()), held);
}

TEST(Deformer, CarriesAPileOverTheEdgesOfTiles) {
    // A cone of loose base on the corner of four tiles settles as if there were no tiles.
    Heightfield ground = test::flat_ground(200, 190);
    const Heightfield pile = test::cone(61, 14, 1.6);
    for (int y = 0; y < 61; ++y)
        for (int x = 0; x < 61; ++x)
            ground.heights(98 + x, 98 + y) = pile.heights(x, y);
    Deformer deformer(ground, SoilField({.repose_deg = 30, .diffusion = 0.25}),
                      {.keep_base = false});
    const DeformerReport report = deformer.settle(1000, 0.0);
    EXPECT_TRUE(report.at_rest);
    EXPECT_EQ(deformer.displaced_volume(), 0.0);
    const FloatRaster heights = deformer.heights({98, 98, 61, 61});
    for (int y = 0; y < 61; ++y)
        for (int x = 0; x < 61; ++x) {
            EXPECT_EQ(heights(x, y), heights(60 - x, y));
            EXPECT_EQ(heights(x, y), heights(y, x));
            if (x > 0) {
                EXPECT_LE(std::fabs(heights(x, y) - heights(x - 1, y)), 0.5774F + 1e-3F);
            }
        }
}

TEST(Deformer, KeepsVolumeOverManySteps) {
    // Piles and a moving contact apart, as the literal form's drift is told.
    const Heightfield pile = test::cone(64, 20, 2.0, 0.05);
    Deformer piles(pile, SoilField(kSand), {.keep_base = false});
    for (int frame = 0; frame < 500; ++frame)
        piles.step({});
    EXPECT_EQ(piles.displaced_volume(), 0.0);

    const Heightfield flat = test::flat_ground(64, 48, 0.05);
    Deformer contact(flat, SoilField(kPebbles));
    for (int frame = 0; frame < 200; ++frame) {
        const Load load =
            test::ball(32 + 20 * std::sin(0.1 * frame), 24, 6, -0.1, 0.4F, 0.6F, 0.05);
        contact.step({&load, 1});
    }
    EXPECT_EQ(contact.displaced_volume(), 0.0);
    EXPECT_NE(contact.displacement(contact.extent()), test::zeros_like(flat));
}

TEST(Deformer, MoreIterationsSpreadFaster) {
    const auto reach = [](int iterations) {
        const Heightfield ground = test::flat_ground(80, 80);
        Deformer deformer(ground, SoilField(kSand), {.iterations = iterations});
        const Load load = test::ball(40, 40, 6, -3.0, 0.0F, 0.6F);
        for (int frame = 0; frame < 4; ++frame)
            deformer.step({&load, 1});
        const FloatRaster u = deformer.displacement(deformer.extent());
        return std::count_if(u.begin(), u.end(), [](float v) { return v != 0.0F; });
    };
    EXPECT_LT(reach(1), reach(3));
    EXPECT_LT(reach(3), reach(5));
    EXPECT_LT(reach(5), reach(8));
}

TEST(Deformer, ReadsWindowsAcrossTiles) {
    const Heightfield ground = test::rough_ground(300, 280, 1.0, 1);
    Deformer deformer(ground, SoilField(kSand));
    const Load load = test::ball(128, 128, 9, -1.0, 0.4F, 0.4F);
    deformer.step({&load, 1});
    const FloatRaster whole = deformer.displacement(deformer.extent());
    const FloatRaster part = deformer.displacement({110, 119, 40, 30});
    const FloatRaster heights = deformer.heights({110, 119, 40, 30});
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            EXPECT_EQ(part(x, y), whole(110 + x, 119 + y));
            EXPECT_EQ(heights(x, y), ground.heights(110 + x, 119 + y) + part(x, y));
        }
    Deformer moved = std::move(deformer);
    EXPECT_EQ(moved.displacement(moved.extent()), whole);
    EXPECT_TRUE(moved.displacement({5, 5, 0, 3}).empty());
}

TEST(DeformerErrors, NameTheValueAndTheRemedy) {
    const Heightfield ground = test::flat_ground(8, 8);
    const SoilField field(kSand);
    EXPECT_THAT([&] { Deformer(ground, field, {.time_step = 1.3}); },
                ThrowsMessage<InvalidOption>(AllOf(HasSubstr("time-step is 1.3"),
                                                   HasSubstr("largest diffusion 0.2"),
                                                   HasSubstr("stability bound 0.25"))));
    EXPECT_NO_THROW(Deformer(ground, field, {.time_step = 1.25}));
    EXPECT_THAT([&] { Deformer(ground, field, {.slide = Slide::Gain}); },
                ThrowsMessage<InvalidOption>(HasSubstr("stability bound 0.125")));
    EXPECT_NO_THROW(Deformer(ground, field, {.slide = Slide::Gain, .time_step = 0.625}));
    EXPECT_THAT([&] { Deformer(ground, field, {.iterations = 0}); },
                ThrowsMessage<InvalidOption>(HasSubstr("iterations is 0")));
    Heightfield high = ground;
    high.heights(1, 1) = 2e9F;
    EXPECT_THAT([&] { Deformer(high, field); }, ThrowsMessage<InvalidInput>(HasSubstr("2e+09 m")));
    Deformer deformer(ground, field);
    EXPECT_THAT(
        [&] {
            deformer.displacement({4, 4, 5, 2});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("5 x 2 cells at (4, 4)")));
    Load load = test::ball(4, 4, 2, 0, 1.0F, 0.0F);
    load.force_z = FloatRaster(1, 1);
    EXPECT_THROW(deformer.step({&load, 1}), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
