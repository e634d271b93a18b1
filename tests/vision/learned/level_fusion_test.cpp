#include "vision/learned/level_fusion.h"

#include "base/error.h"
#include "base/parallel.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

LogitPlanes waves(int width, int height, double length) {
    LogitPlanes planes;
    for (std::size_t k = 0; k < planes.size(); ++k) {
        planes[k] = FloatRaster(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                planes[k](x, y) =
                    static_cast<float>(3.0 * std::sin((x + y) / length + static_cast<double>(k)));
    }
    return planes;
}

LevelStack stack_of(int width, int height) {
    LevelStack stack;
    for (int level = 0; level < 3; ++level) {
        stack.levels.push_back(waves(width, height, 20.0 / (1 << level)));
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    return stack;
}

double squashed(double logit) {
    return 1.0 / (1.0 + std::exp(-logit));
}

TEST(FuseLevels, OneScaleIsItsOwnField) {
    const LevelStack stack = stack_of(70, 131);
    const EdgeField field = fuse_levels(LevelStack(stack), {.n_levels = 1});
    for (int y = 0; y < 131; ++y)
        for (int x = 0; x < 70; ++x)
            ASSERT_NEAR(field.inside(x, y), squashed(stack.levels[0][1](x, y)), 1e-6);
}

TEST(FuseLevels, WithoutATableItIsTheMeanOfTheLogits) {
    const EdgeField field = fuse_levels(stack_of(150, 201), {.n_levels = 3});
    // The same wave at every scale; where it is enlarged its crests lose little.
    const auto wave = [](double x, double y) { return 3.0 * std::sin((x + y) / 20.0); };
    for (int y = 8; y < 193; ++y) {
        for (int x = 8; x < 142; ++x) {
            double mean = 0.0;
            for (const int step : {1, 2, 4})
                mean += wave(x - 0.5 * (step - 1), y - 0.5 * (step - 1)) / 3.0;
            ASSERT_NEAR(field.boundary(x, y), squashed(mean), 0.01) << x << ' ' << y;
        }
    }
}

TEST(FuseLevels, ATableMayPickAnyScale) {
    // One layer that reads inputs 3, 4, 5: the scale at 1/2.
    FusionModel model{.n_levels = 3};
    DenseLayer layer{9, 3, std::vector<float>(27), {0, 0, 0}};
    for (std::size_t k = 0; k < 3; ++k)
        layer.weights[k * 9 + 3 + k] = 1.0F;
    model.network.layers = {layer};
    LevelStack stack = stack_of(64, 128);
    stack.levels[1].fill(FloatRaster(32, 64, 1.5F));
    const EdgeField field = fuse_levels(std::move(stack), model);
    for (const float value : field.distance)
        ASSERT_NEAR(value, squashed(1.5), 1e-6);
}

TEST(FuseLevels, MissingScalesHaveStandIns) {
    LevelStack stack;
    stack.levels.push_back(waves(33, 20, 9.0));
    const FusionModel model{.reads_doubled = true, .n_levels = 4};
    const EdgeField field = fuse_levels(LevelStack(stack), model);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 33; ++x)
            ASSERT_NEAR(field.inside(x, y), squashed(stack.levels[0][1](x, y)), 1e-6);
}

TEST(FuseLevels, SameBytesForAnyThreadCount) {
    const auto fused = [](int n_threads) {
        const ThreadLimit limit(n_threads);
        return fuse_levels(stack_of(300, 400), {.n_levels = 3}).boundary;
    };
    EXPECT_EQ(fused(1), fused(4));
}

TEST(ReadFusion, TakesATableThatFitsAndRefusesOthers) {
    const std::vector<double> mean = {1, 3, 0};
    EXPECT_TRUE(read_fusion(mean).reads_doubled);
    EXPECT_EQ(read_fusion(mean).n_levels, 3);
    std::vector<double> table = {0, 1, 1, 3, 3};
    table.resize(5 + 9 + 3, 0.5);
    EXPECT_EQ(read_fusion(table).network.n_in(), 3);
    table[1] = 2;  // two scales have six inputs
    EXPECT_THROW(read_fusion(table), InvalidInput);
    EXPECT_THROW(read_fusion(std::vector<double>{0, 9, 0}), InvalidInput);
    EXPECT_THROW(read_fusion(std::vector<double>{0, 1}), InvalidInput);
    EXPECT_THROW(read_fusion(std::vector<double>{0, 1, 2, 3}), InvalidInput);
}

}  // namespace
}  // namespace scree::vision
