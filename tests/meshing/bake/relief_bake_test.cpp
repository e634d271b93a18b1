#include "meshing/bake/relief_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/bake/height_bake.h"
#include "tests/support/placed_rocks.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

FloatRaster random_signal(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed});
    FloatRaster signal(width, height);
    for (float& s : signal)
        s = static_cast<float>(rng.uniform(-1.0, 1.0));
    return signal;
}

LabelMap labels_of(const vision::RockSet& set) {
    std::vector<vision::Outline> outlines;
    for (const vision::Rock& rock : set.rocks)
        outlines.push_back(rock.outline);
    return vision::paint_labels(outlines, set.width, set.height);
}

class ReliefBake : public testing::TestWithParam<unsigned> {  // the parameter is a seed
protected:
    vision::RockSet set_ = test::scattered_rocks(140, 100, 30, 5.0, 22.0, GetParam());
    FloatRaster signal_ = random_signal(140, 100, GetParam() + 50);
    LabelMap labels_ = labels_of(set_);
};

TEST_P(ReliefBake, WithoutDetailIsTheClosedForm) {
    const auto domes = bake_displacement(set_);
    const auto relief = bake_displacement(set_, {signal_, labels_}, {.detail = 0.0});
    EXPECT_EQ(relief.metres, domes.metres);
    EXPECT_EQ(relief.metres_per_pixel, domes.metres_per_pixel);
}

TEST_P(ReliefBake, MovesNoRockOnAverage) {
    const auto domes = bake_displacement(set_);
    const auto relief = bake_displacement(set_, {signal_, labels_}, {.detail = 0.3});
    std::vector<double> moved(set_.rocks.size() + 1, 0.0);
    std::vector<double> path(set_.rocks.size() + 1, 0.0);
    for (std::size_t i = 0; i < labels_.size(); ++i) {
        const auto change = static_cast<double>(relief.metres.data()[i] - domes.metres.data()[i]);
        moved[labels_.data()[i]] += change;
        path[labels_.data()[i]] += std::abs(change);
    }
    for (std::size_t rock = 1; rock < moved.size(); ++rock)
        EXPECT_LE(std::abs(moved[rock]), 1e-5 * path[rock] + 1e-9) << rock;
    EXPECT_GT(path[1], 0.0);
}

TEST_P(ReliefBake, GapsLieBelowTheFeetOfRocksAndNoDeeperThanPromised) {
    const auto domes = bake_displacement(set_);
    const auto relief = bake_displacement(set_, {signal_, labels_}, {.detail = 0.2});
    std::vector<float> depths;
    for (const vision::Rock& rock : set_.rocks)
        depths.push_back(rock.depth);
    std::nth_element(depths.begin(), depths.begin() + 15, depths.end());
    const double deepest = 6.0 * 0.2 * static_cast<double>(depths[15]) * scale_of(set_);
    for (std::size_t i = 0; i < domes.metres.size(); ++i) {
        const float before = domes.metres.data()[i];
        const float after = relief.metres.data()[i];
        if (before > 0.0F)
            ASSERT_GE(after, 0.0F) << "a rock fell below its own foot";
        else
            ASSERT_LE(after, 0.0F);
        ASSERT_GE(after, -1.0001 * deepest);
        ASSERT_LE(after, before * 1.41F);
    }
}

TEST_P(ReliefBake, SameBytesOnAnyThreadCount) {
    const auto many = bake_displacement(set_, {signal_, labels_});
    const ThreadLimit one(1);
    EXPECT_EQ(many.metres, bake_displacement(set_, {signal_, labels_}).metres);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ReliefBake, testing::Range(0U, 4U));

TEST(ReliefBakeForm, BrightSpotOnARockRisesByTheStatedShare) {
    vision::RockSet set = test::empty_picture(61, 61, 0.01);
    vision::Rock rock;
    rock.outline.centre = {30.5, 30.5};
    rock.outline.radii.fill(20.0F);
    rock.depth = 10.0F;
    set.rocks.push_back(rock);
    FloatRaster signal(61, 61, 0.0F);
    signal(30, 30) = 1.0F;
    const auto map = bake_displacement(set, {signal, labels_of(set)}, {.detail = 0.2});
    EXPECT_NEAR(map.metres(30, 30), 0.1 * 1.2, 1e-4);  // the mean of the signal is nearly 0
    EXPECT_NEAR(map.metres(2, 2), -3.0 * 0.2 * 0.1, 1e-6);
    EXPECT_NEAR(typical_radius(set), 20.0, 0.01);
}

TEST(ReliefBakeForm, AMapWithoutRocksIsFlat) {
    const auto map = bake_displacement(test::empty_picture(20, 10, 0.01),
                                       {random_signal(20, 10, 1), LabelMap(20, 10)});
    for (const float y : map.metres)
        EXPECT_EQ(y, 0.0F);
    EXPECT_EQ(typical_radius(test::empty_picture(20, 10, 0.01)), 0.0);
}

TEST(ReliefBakeForm, RefusesSignalsThatAreNone) {
    const auto set = test::scattered_rocks(30, 20, 3, 3.0, 6.0, 1);
    const LabelMap labels = labels_of(set);
    const FloatRaster flat(30, 20);
    EXPECT_THROW(bake_displacement(set, {FloatRaster(20, 30), labels}), InvalidInput);
    EXPECT_THROW(bake_displacement(set, {flat, LabelMap(20, 30)}), InvalidInput);
    EXPECT_THROW(bake_displacement(set, {flat, LabelMap(30, 20, 4)}), InvalidInput);
    EXPECT_THROW(bake_displacement(set, {FloatRaster(30, 20, 1.5F), labels}), InvalidInput);
    EXPECT_THROW(bake_displacement(set, {FloatRaster(30, 20, std::nanf("")), labels}),
                 InvalidInput);
    EXPECT_THROW(bake_displacement(set, {flat, labels}, {.detail = 0.6}), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
