#include "testdata/gravel_scene.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

namespace scree::test {
namespace {

SceneOptions small(std::uint64_t seed) {
    SceneOptions options = varied_scene(seed, 128, 96);
    options.greatest = std::min(options.greatest, 60.0);
    options.least = std::min(options.least, options.greatest);
    return options;
}

double mean_light(const GravelScene& scene) {
    double sum = 0.0;
    for (const glm::u8vec3 pixel : scene.photo)
        sum += pixel.y;
    return sum / static_cast<double>(scene.photo.size());
}

TEST(GravelScene, SameSeedGivesSameBytesOnAnyThreadCount) {
    const GravelScene first = make_gravel_scene(small(3));
    const ThreadLimit one(1);
    const GravelScene second = make_gravel_scene(small(3));
    EXPECT_EQ(first.photo, second.photo);
    EXPECT_EQ(first.labels, second.labels);
    EXPECT_EQ(first.ignore, second.ignore);
    EXPECT_EQ(first.height, second.height);
    EXPECT_NE(first.photo, make_gravel_scene(small(4)).photo);
}

TEST(GravelScene, LabelsAreNumberedWithoutGapsAndNoneIsTiny) {
    for (const std::uint64_t seed : {5U, 6U, 7U}) {
        const GravelScene scene = make_gravel_scene(small(seed));
        const auto greatest = *std::max_element(scene.labels.begin(), scene.labels.end());
        std::vector<int> pixels(greatest + 1U, 0);
        for (const std::uint16_t label : scene.labels)
            ++pixels[label];
        ASSERT_GT(greatest, 3) << seed;
        for (std::size_t label = 1; label < pixels.size(); ++label)
            EXPECT_GE(pixels[label], 1) << seed << ", rock " << label;
        for (std::size_t i = 0; i < scene.labels.size(); ++i)
            ASSERT_FALSE(scene.labels.data()[i] != 0 && scene.ignore.data()[i] != 0);
    }
}

TEST(GravelScene, LooksDoNotMoveTheRocks) {
    SceneOptions options = small(8);
    const GravelScene before = make_gravel_scene(options);
    options.palette = options.palette == Palette::Slate ? Palette::Quartz : Palette::Slate;
    options.sun = 0.9 - 0.8 * options.sun;
    options.bedding = 1.0 - options.bedding;
    const GravelScene after = make_gravel_scene(options);
    EXPECT_EQ(before.labels, after.labels);
    EXPECT_EQ(before.height, after.height);
    EXPECT_NE(before.photo, after.photo);
}

TEST(GravelScene, ThingsAreNoRocks) {
    SceneOptions options = small(9);
    options.coverage = 0.0;
    options.pebbles = 0.0;
    options.n_things = 12;
    const GravelScene scene = make_gravel_scene(options);
    EXPECT_EQ(std::set<std::uint16_t>(scene.labels.begin(), scene.labels.end()),
              std::set<std::uint16_t>{0});
    options.n_things = 0;
    EXPECT_NE(scene.photo, make_gravel_scene(options).photo);
}

TEST(GravelScene, ClutterIsIgnoredAndGetsNoLabel) {
    SceneOptions options = small(10);
    options.coverage = 0.0;
    options.pebbles = 0.6;
    options.n_things = 0;
    const GravelScene scene = make_gravel_scene(options);
    EXPECT_EQ(*std::max_element(scene.labels.begin(), scene.labels.end()), 0);
    const auto ignored = std::count(scene.ignore.begin(), scene.ignore.end(), 255);
    EXPECT_GT(ignored, 1000);
}

TEST(GravelScene, RocksStandAboveTheGroundWhereNothingIsBuried) {
    SceneOptions options = small(11);
    options.coverage = 0.5;
    options.burial = 0.0;
    options.pebbles = 0.0;
    options.n_things = 0;
    const GravelScene scene = make_gravel_scene(options);
    double rock = 0.0;
    double ground = 0.0;
    double n_rock = 0.0;
    for (std::size_t i = 0; i < scene.labels.size(); ++i) {
        const bool is_rock = scene.labels.data()[i] != 0;
        (is_rock ? rock : ground) += static_cast<double>(scene.height.data()[i]);
        n_rock += is_rock ? 1.0 : 0.0;
    }
    EXPECT_GT(rock / n_rock, ground / (static_cast<double>(scene.labels.size()) - n_rock) + 1.0);
}

TEST(GravelScene, VariedScenesAreAllowedAndDiffer) {
    std::set<double> lights;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const SceneOptions options = varied_scene(seed, 512, 512);
        EXPECT_NO_THROW(check(options)) << seed;
        EXPECT_LE(options.least, options.greatest) << seed;
        lights.insert(options.light_azimuth);
    }
    EXPECT_EQ(lights.size(), 200U);
}

TEST(GravelScene, ExposureBrightens) {
    SceneOptions options = small(12);
    options.exposure = 0.6;
    const double dark = mean_light(make_gravel_scene(options));
    options.exposure = 1.2;
    EXPECT_GT(mean_light(make_gravel_scene(options)), dark + 5.0);
}

TEST(GravelScene, BadOptionsAreNamed) {
    SceneOptions options;
    options.least = 50;
    options.greatest = 20;
    EXPECT_THROW(make_gravel_scene(options), InvalidOption);
    options = {};
    options.sun = std::nan("");
    EXPECT_THROW(make_gravel_scene(options), InvalidOption);
}

}  // namespace
}  // namespace scree::test
