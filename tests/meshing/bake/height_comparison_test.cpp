#include "meshing/bake/height_comparison.h"

#include "base/error.h"
#include "meshing/bake/height_bake.h"
#include "tests/support/placed_rocks.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

struct Scene {
    vision::RockSet rocks;
    FloatRaster truth;
    LabelMap labels;
    Photo photo;
};

std::uint8_t coded(double light) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(light, 0.0, 1.0)));
}

// Rocks of their own grey, lit from the upper left, speckled, on sand: what a camera sees of
// heights that are known.
Scene lit_scene(std::uint64_t seed) {
    Scene scene;
    scene.rocks = test::scattered_rocks(220, 160, 60, 8.0, 22.0, seed);
    scene.truth = bake_displacement(scene.rocks).metres;
    std::vector<vision::Outline> outlines;
    for (const auto& rock : scene.rocks.rocks)
        outlines.push_back(rock.outline);
    scene.labels = vision::paint_labels(outlines, 220, 160);
    scene.photo = Photo(220, 160);
    Rng rng({.seed = seed, .stream = 1});
    std::vector<double> albedo(scene.rocks.rocks.size() + 1);
    for (double& a : albedo)
        a = rng.uniform(0.2, 0.9);
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 220; ++x) {
            const auto& h = scene.truth;
            const double right = (h(std::min(x + 1, 219), y) - h(std::max(x - 1, 0), y)) / 0.004;
            const double down = (h(x, std::min(y + 1, 159)) - h(x, std::max(y - 1, 0))) / 0.004;
            const double lit = std::max(
                0.1, (right + down + 1.5) / (2.06 * std::sqrt(1 + right * right + down * down)));
            const double speckle = 1.0 + 0.3 * rng.normal();
            const auto v = coded(lit * albedo[scene.labels(x, y)] * speckle);
            scene.photo(x, y) = glm::u8vec3(v);
        }
    return scene;
}

void record(const std::string& map, const HeightComparison& figures) {
    testing::Test::RecordProperty(map + "_correlation", std::to_string(figures.correlation));
    testing::Test::RecordProperty(map + "_fine_inside", std::to_string(figures.fine_inside));
    testing::Test::RecordProperty(map + "_step_at_borders",
                                  std::to_string(figures.step_at_borders));
}

class HeightComparisonOf : public testing::TestWithParam<unsigned> {};

// DB-02: bakes from rocks follow the truth, are smooth inside and stand out at borders; brightness
// does none of it.
TEST_P(HeightComparisonOf, RocksBeatBrightnessInEveryFigure) {
    const Scene scene = lit_scene(GetParam());
    vision::RockSet found = scene.rocks;  // outlines a few per cent off, as a finder gives them
    Rng rng({.seed = GetParam(), .stream = 2});
    for (auto& rock : found.rocks) {
        rock.outline.centre += glm::dvec2(rng.normal(), rng.normal()) * 0.5;
        for (float& r : rock.outline.radii)
            r *= static_cast<float>(1.0 + 0.03 * rng.uniform(-1.0, 1.0));
    }
    const auto grey = compare_heights(brightness_as_height(scene.photo), scene.truth, scene.labels);
    const auto baked = compare_heights(bake_displacement(found).metres, scene.truth, scene.labels);
    EXPECT_GT(baked.correlation, 0.9);
    EXPECT_LT(std::abs(grey.correlation), 0.5);
    EXPECT_LT(baked.fine_inside, 0.3 * grey.fine_inside);
    EXPECT_GT(baked.step_at_borders, 1.5 * grey.step_at_borders);
    record("brightness", grey);  // --gtest_output=json: writes them out for the docs
    record("bake", baked);
}
INSTANTIATE_TEST_SUITE_P(Seeds, HeightComparisonOf, testing::Range(0U, 3U));

TEST(HeightComparison, TruthComparedWithItselfIsPerfectAndUnitsDoNotMatter) {
    const Scene scene = lit_scene(5);
    FloatRaster other = scene.truth;
    for (float& h : other)
        h = 3.0F - 40.0F * h;
    const auto same = compare_heights(scene.truth, scene.truth, scene.labels);
    const auto turned = compare_heights(other, scene.truth, scene.labels);
    EXPECT_NEAR(same.correlation, 1.0, 1e-9);
    EXPECT_NEAR(turned.correlation, -1.0, 1e-6);
    EXPECT_NEAR(turned.fine_inside, same.fine_inside, 1e-3 * same.fine_inside);
    EXPECT_NEAR(turned.step_at_borders, same.step_at_borders, 1e-3 * same.step_at_borders);
}

TEST(HeightComparison, FlatMapsAndPicturesWithoutRocksGiveZeros) {
    const FloatRaster flat(30, 20);
    const auto result = compare_heights(flat, flat, LabelMap(30, 20));
    EXPECT_EQ(result.correlation, 0.0);
    EXPECT_EQ(result.fine_inside, 0.0);
    EXPECT_EQ(result.step_at_borders, 0.0);
}

TEST(HeightComparison, BrightnessIsTheLumaOfThePicture) {
    const Photo photo(2, 1, glm::u8vec3(255, 0, 0));
    EXPECT_FLOAT_EQ(brightness_as_height(photo)(1, 0), 0.2126F);
}

TEST(HeightComparisonErrors, NameTheSizes) {
    EXPECT_THAT([] { compare_heights(FloatRaster(3, 2), FloatRaster(2, 3), LabelMap(3, 2)); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("3 x 2, 2 x 3")));
    EXPECT_THROW(compare_heights(FloatRaster(1, 1, NAN), FloatRaster(1, 1), LabelMap(1, 1)),
                 InvalidInput);
    EXPECT_THROW(
        compare_heights(FloatRaster(1, 1), FloatRaster(1, 1), LabelMap(1, 1), {.filter_px = 0.0}),
        InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
