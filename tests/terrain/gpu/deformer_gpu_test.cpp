#include "terrain/gpu/deformer_gpu.h"

#include "tests/terrain/gpu/gl_fixture.h"
#include "tests/terrain/grid/ground_fixtures.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

// The most that displacements may be apart, in cell sizes: quanta are 2^-18 of one.
constexpr float kTolerance = 1e-4F;

float greatest_difference(const FloatRaster& a, const FloatRaster& b) {
    float greatest = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i)
        greatest = std::max(greatest, std::abs(a.data()[i] - b.data()[i]));
    return greatest;
}

float greatest_move(const FloatRaster& u) {
    return greatest_difference(u, FloatRaster(u.width(), u.height()));
}

class GpuDeformers : public test::GlTest {
protected:
    // Frames under two moving balls, then without, on the processor and on the device.
    void compare(const Heightfield& base, const SoilField& soil, const DeformerOptions& options,
                 float tolerance = kTolerance) {
        Deformer cpu(base, soil, options);
        GpuDeformer gpu(context(), base, soil, options);
        double cpu_compacted = 0.0;
        double gpu_compacted = 0.0;
        for (int frame = 0; frame < 9; ++frame) {
            std::vector<Load> loads;
            if (frame % 3 != 2) {
                loads.push_back(scree::test::ball(14.0 + frame, 20.0, 6.0, -1.0, 2.0F, 1.0F));
                loads.push_back(scree::test::ball(2.0 + frame, 36.0, 5.0, -0.5, 0.5F, 2.0F));
            }
            cpu_compacted += cpu.step(loads).compacted_m3;
            gpu_compacted += gpu.step(loads).compacted_m3;
        }
        const FloatRaster wanted = cpu.displacement(cpu.extent());
        EXPECT_GT(greatest_move(wanted), 0.2F);
        EXPECT_LE(greatest_difference(wanted, gpu.displacement(gpu.extent())), tolerance);
        EXPECT_TRUE(wanted == gpu.displacement(gpu.extent())) << "close, not the same bits";
        EXPECT_NEAR(gpu.displaced_volume(), cpu.displaced_volume(), 1e-3);
        EXPECT_NEAR(gpu_compacted, cpu_compacted, 1e-3);
        const CellWindow part{5, 7, 20, 11};
        EXPECT_LE(greatest_difference(cpu.heights(part), gpu.heights(part)), tolerance);
    }
};

TEST_F(GpuDeformers, AgreeWithTheProcessorOnRoughGroundOfOneSoil) {
    const Heightfield base = scree::test::rough_ground(61, 45, 1.5, 3);
    compare(base, SoilField(kSand), {});
}

TEST_F(GpuDeformers, AgreeOnThreeSoilsWithTheBaseFreeToSlide) {
    const Heightfield base = scree::test::rough_ground(61, 45, 3.0, 4);
    compare(base, SoilField(scree::test::patchwork(61, 45, 5), 1.0), {.keep_base = false});
}

TEST_F(GpuDeformers, AgreeForTheOtherSlidesAndBorders) {
    const Heightfield base = scree::test::rough_ground(61, 45, 3.0, 6);
    compare(base, SoilField(kSand), {.slide = Slide::Weight, .border = Border::Zero});
    compare(base, SoilField(Soil{.diffusion = 0.12}),
            {.slide = Slide::Gain, .iterations = 5, .keep_base = false});
}

TEST_F(GpuDeformers, KeepVolumeAndComeToRest) {
    const Heightfield base = scree::test::cone(32, 9.0, 1.2);
    GpuDeformer gpu(context(), base, SoilField(kSand), {.iterations = 16, .keep_base = false});
    const DeformerReport report = gpu.settle(4000, 1e-4);
    EXPECT_TRUE(report.at_rest);
    EXPECT_GT(greatest_move(gpu.displacement(gpu.extent())), 1.0F);
    EXPECT_NEAR(gpu.displaced_volume(), 0.0, 1e-6);
}

TEST_F(GpuDeformers, GoOnFromReplacedDisplacements) {
    const Heightfield base = scree::test::flat_ground(48, 40);
    const FloatRaster pile = scree::test::rough_ground(48, 40, 3.0, 9).heights;
    Deformer cpu(base, SoilField(kSand));
    GpuDeformer gpu(context(), base, SoilField(kSand));
    cpu.replace_displacement(pile);
    gpu.replace_displacement(pile);
    cpu.step({});
    gpu.step({});
    EXPECT_TRUE(cpu.displacement(cpu.extent()) == gpu.displacement(gpu.extent()));
    EXPECT_THROW(gpu.replace_displacement(FloatRaster(4, 4)), InvalidInput);
}

// The published scheme with its switches, beside borders of materials and under loads.
TEST_F(GpuDeformers, AgreeInTheLiteralReading) {
    const Heightfield base = scree::test::rough_ground(61, 45, 1.5, 3, 0.0, 0.5);
    const SoilField patches(scree::test::patchwork(61, 45, 5), 0.5);
    for (const DeformerOptions& options : {DeformerOptions{.reading = Reading::Literal},
                                           DeformerOptions{.reading = Reading::Literal,
                                           .border = Border::Zero,
                                           .terms = LiteralTerms::ChainRule},
                                           DeformerOptions{.reading = Reading::Literal,
                                           .time_step = 0.7,
                                           .clamp_weights = true,
                                           .literal_plus_sign = true}}) {
        compare(base, patches, options, 0.5F * kTolerance);
        compare(base, SoilField(kSand), options, 0.5F * kTolerance);
    }
    GpuDeformer gpu(context(), base, patches, {.reading = Reading::Literal});
    EXPECT_EQ(greatest_move(gpu.displacement(gpu.extent())), 0.0F);
    const FloatRaster pile = scree::test::rough_ground(61, 45, 1.0, 9).heights;
    gpu.replace_displacement(pile);
    EXPECT_LE(greatest_difference(gpu.displacement(gpu.extent()), pile), 1e-6F);
}

TEST_F(GpuDeformers, RefuseStepsBeyondTheBound) {
    const Heightfield base = scree::test::flat_ground(8, 8);
    EXPECT_THROW(GpuDeformer(context(), base, SoilField(kSand), {.time_step = 2.0}), InvalidOption);
    const GpuDeformer gpu(context(), base, SoilField(kSand));
    EXPECT_THROW(gpu.displacement({4, 4, 8, 2}), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
