#include "terrain/material/material_layers.h"

#include "base/error.h"
#include "base/parallel.h"
#include "tests/terrain/material/map_samples.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<double> thickness(const MaterialLayers& layers, std::size_t n) {
    std::vector<double> sums;
    for (std::size_t i = 0; i < layers.amounts[n][0].size(); ++i) {
        double sum = 0.0;
        for (const auto& amounts : layers.amounts[n])
            sum += amounts.data()[i];
        sums.push_back(sum);
    }
    return sums;
}

class MaterialLayersSeeds : public testing::TestWithParam<unsigned> {};

// Row DM-08: mass kept for every material, thickness of every cell, no negative amounts.
TEST_P(MaterialLayersSeeds, MixingKeepsMassAndThickness) {
    const double depths[] = {0.1, 0.3, 0.05};
    MaterialLayers layers = layers_of_map(test::random_map(17, 13, GetParam(), false), depths);
    layers.amounts[1][0](4, 4) = 0.0;  // an uneven stack with a hole
    layers.amounts[1][1](4, 4) = 0.0;
    layers.amounts[1][2](4, 4) = 0.0;
    layers.amounts[0][2](8, 8) += 0.7;
    std::vector<std::vector<double>> before;
    for (std::size_t n = 0; n < 3; ++n)
        before.push_back(thickness(layers, n));
    const MixReport report = mix_layers(layers, {.steps = 60, .sideways = 0.25, .downwards = 0.5});
    for (std::size_t m = 0; m < 3; ++m)
        EXPECT_NEAR(report.after_m3[m], report.before_m3[m], 1e-13 * 17 * 13);
    for (std::size_t n = 0; n < 3; ++n) {
        const auto after = thickness(layers, n);
        for (std::size_t i = 0; i < after.size(); ++i)
            EXPECT_NEAR(after[i], before[n][i], 1e-13);
        for (const auto& amounts : layers.amounts[n])
            for (const double amount : amounts)
                EXPECT_GE(amount, 0.0);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, MaterialLayersSeeds, testing::Range(0U, 4U));

TEST(MaterialLayers, MixToOneMixtureEverywhere) {
    DescriptionMap map = test::random_map(6, 5, 3, false);
    const double depth[] = {0.2};
    MaterialLayers layers = layers_of_map(map, depth);
    const double share = material_volumes(layers)[0] / (0.2 * 6 * 5 * 0.25 * 0.25);
    mix_layers(layers, {.steps = 2000, .sideways = 0.2});
    for (const double amount : layers.amounts[0][0])
        EXPECT_NEAR(amount, 0.2 * share, 1e-9);
}

// Two cells exchange by closed form: the difference shrinks by 1 - 2k a step.
TEST(MaterialLayers, TwoLayersMixByTheClosedForm) {
    DescriptionMap map;
    map.materials = test::three_materials();
    map.ids = Raster<std::uint8_t>(1, 1);
    const double depths[] = {0.1, 0.1};
    const int below[] = {7};
    MaterialLayers layers = layers_of_map(map, depths, below);
    mix_layers(layers, {.steps = 3, .sideways = 0.0, .downwards = 0.1});
    const double difference = 0.8 * 0.8 * 0.8;
    EXPECT_NEAR(layers.amounts[0][0](0, 0), 0.05 * (1.0 + difference), 1e-15);
    EXPECT_NEAR(layers.amounts[0][2](0, 0), 0.05 * (1.0 - difference), 1e-15);
    EXPECT_NEAR(layers.amounts[1][2](0, 0), 0.05 * (1.0 + difference), 1e-15);
}

TEST(MaterialLayers, SurfaceInterpolatesParametersByVolume) {
    DescriptionMap map;
    map.materials = test::three_materials();
    map.ids = Raster<std::uint8_t>(1, 1);
    const double depths[] = {0.1, 0.3};
    const int below[] = {3};
    const MaterialLayers layers = layers_of_map(map, depths, below);
    const DescriptionMap top = surface_map(layers, 0.1);
    EXPECT_EQ(top.ids(0, 0), 0);
    EXPECT_NEAR(top.mobility(0, 0), 0.5, 1e-7);
    EXPECT_NEAR(top.repose(0, 0), 34 * kDegree, 1e-7);
    const DescriptionMap deep = surface_map(layers, 0.4);
    EXPECT_EQ(deep.ids(0, 0), 3);
    EXPECT_NEAR(deep.mobility(0, 0), 0.25 * 0.5 + 0.75 * 0.25, 1e-7);
    EXPECT_NEAR(std::tan(deep.repose(0, 0)),
                0.25 * std::tan(34 * kDegree) + 0.75 * std::tan(15 * kDegree), 1e-7);
    EXPECT_NEAR(surface_map(layers, 0.2).mobility(0, 0), 0.375, 1e-7);
    EXPECT_NEAR(surface_map(layers, 99.0).mobility(0, 0), deep.mobility(0, 0), 1e-7);
}

TEST(MaterialLayers, SurfaceOfUnmixedLayersIsTheMap) {
    const DescriptionMap map = test::random_map(9, 8, 5, false);
    const double depths[] = {0.1, 0.3};
    const DescriptionMap top = surface_map(layers_of_map(map, depths), 0.4);
    EXPECT_EQ(top.ids, map.ids);
    EXPECT_EQ(top.materials, map.materials);
}

TEST(MaterialLayers, AreTheSameForAnyThreadCount) {
    const double depths[] = {0.1, 0.2};
    const MaterialLayers start = layers_of_map(test::random_map(60, 50, 6, false), depths);
    MaterialLayers many = start, one = start;
    const MixOptions options{.steps = 5, .sideways = 0.1, .downwards = 0.1};
    mix_layers(many, options);
    const ThreadLimit limit(1);
    mix_layers(one, options);
    EXPECT_EQ(many.amounts, one.amounts);
    EXPECT_TRUE(test::same_map(surface_map(many, 0.15), surface_map(one, 0.15)));
}

TEST(MaterialLayers, SayWhatIsWrong) {
    const DescriptionMap map = test::random_map(4, 4, 1, false);
    const double depths[] = {0.1, 0.2};
    const int below[] = {5};
    const auto refused = [](auto&& call, const std::string& words) {
        EXPECT_THAT(call, ThrowsMessage<InvalidInput>(HasSubstr(words)));
    };
    refused([&] { layers_of_map(map, {}); }, "at least one");
    refused([&] { layers_of_map(map, depths, below); }, "id 5, which has no material");
    const double bad[] = {0.1, std::numeric_limits<double>::quiet_NaN()};
    refused([&] { layers_of_map(map, bad); }, "layer 1 has a thickness of nan");
    const int two[] = {0, 0};
    refused([&] { layers_of_map(map, depths, two); }, "1 layers below the first and 2");
    MaterialLayers layers = layers_of_map(map, depths);
    EXPECT_THROW(mix_layers(layers, {.sideways = 0.3}), InvalidOption);
    refused([&] { surface_map(layers, 0.0); }, "depth of the surface is 0");
    layers.amounts[1].pop_back();
    refused([&] { mix_layers(layers); }, "a layer holds 2 materials of 3");
}

}  // namespace
}  // namespace scree::terrain
