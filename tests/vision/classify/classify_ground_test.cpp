#include "vision/classify/classify_ground.h"

#include "base/error.h"
#include "base/parallel.h"
#include "testdata/ground_mosaic.h"
#include "vision/classify/confusion.h"

#include <algorithm>
#include <numeric>

#include <glm/common.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// Seeds that vision/training/train_ground.cpp neither trains nor scores on.
constexpr std::uint64_t kFirstSeed = 500'001;

// Sand on the left, grass on the right: quick to draw.
Photo sand_and_grass(int width, int height, std::uint64_t seed) {
    const auto sand = test::draw_ground(GroundClass::Sand, width, height, seed);
    const auto grass = test::draw_ground(GroundClass::Grass, width, height, seed);
    Photo photo(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 colour = x < width / 2 ? sand(x, y) : grass(x, y);
            photo(x, y) = glm::u8vec3(glm::clamp(colour, 0.0F, 1.0F) * 255.0F);
        }
    return photo;
}

TEST(ClassifyGround, FindsTheClassesOfPicturesItNeverSaw) {
    ConfusionMatrix matrix;
    for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + 8; ++seed) {
        const auto mosaic = test::make_ground_mosaic(200, 200, seed);
        add_to_confusion(matrix, mosaic.classes, classify_ground(mosaic.photo).classes);
    }
    EXPECT_GT(accuracy(matrix), 0.65) << confusion_table(matrix);
}

TEST(ClassifyGround, SmoothingLeavesFewerBorders) {
    const Photo photo = sand_and_grass(200, 200, kFirstSeed + 20);
    const auto borders = [&](double smoothing) {
        GroundOptions options;
        options.smoothing = smoothing;
        const auto classes = classify_ground(photo, options).classes;
        int count = 0;
        for (int y = 0; y < 200; ++y)
            for (int x = 1; x < 200; ++x)
                count += classes(x, y) != classes(x - 1, y) ? 1 : 0;
        return count;
    };
    EXPECT_LT(borders(3.0), borders(0.0));
}

TEST(ClassifyGround, SharesAndConfidenceAddUp) {
    const GroundRegions regions = classify_ground(sand_and_grass(128, 96, kFirstSeed + 21));
    EXPECT_EQ(regions.classes.width(), 128);
    EXPECT_EQ(regions.classes.height(), 96);
    EXPECT_NEAR(std::accumulate(regions.shares.begin(), regions.shares.end(), 0.0), 1.0, 1e-9);
    for (const float value : regions.confidence)
        EXPECT_TRUE(value >= 0.0F && value <= 1.0F);
    EXPECT_GT(regions.pieces, 20);
}

TEST(ClassifyGround, ASteepSlopeLeavesRock) {
    const Photo photo = sand_and_grass(96, 96, kFirstSeed + 22);
    GroundOptions options;
    options.slope_weight = 3.0;
    const GroundRegions regions = classify_ground(photo, options, FloatRaster(96, 96, 85.0F));
    EXPECT_GT(regions.shares[static_cast<std::size_t>(GroundClass::Rock)], 0.95);
    EXPECT_EQ(classify_ground(photo, options, FloatRaster(96, 96, 20.0F)).classes,
              classify_ground(photo).classes);
}

TEST(ClassifyGround, LargePicturesAreWorkedOnSmallerOnes) {
    const Photo photo = sand_and_grass(160, 160, kFirstSeed + 23);
    Photo large(480, 480);
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 480; ++x)
            large(x, y) = photo(x / 3, y / 3);
    GroundOptions options;
    options.max_side = 160;
    const auto small_classes = classify_ground(photo, options).classes;
    const auto classes = classify_ground(large, options).classes;
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 480; ++x)
            ASSERT_EQ(classes(x, y), small_classes(x / 3, y / 3));
}

TEST(ClassifyGround, GivesTheSameBytesForAnyNumberOfThreads) {
    const Photo photo = sand_and_grass(150, 110, kFirstSeed + 24);
    const auto run = [&](int n_threads) {
        const ThreadLimit limit(n_threads);
        const GroundRegions regions = classify_ground(photo);
        return std::pair(regions.classes, regions.confidence);
    };
    EXPECT_EQ(run(1), run(4));
}

TEST(ClassifyGround, WorksOnASinglePixelAndOnOneColour) {
    EXPECT_EQ(classify_ground(Photo(1, 1)).pieces, 1);
    EXPECT_EQ(classify_ground(Photo(70, 3, glm::u8vec3(128))).classes.width(), 70);
}

TEST(ClassifyGroundErrors, NameTheThing) {
    using testing::HasSubstr;
    using testing::ThrowsMessage;
    EXPECT_THAT([] { classify_ground({}); }, ThrowsMessage<InvalidInput>(HasSubstr("no pixels")));
    EXPECT_THAT([] { classify_ground(Photo(9, 9), {}, FloatRaster(9, 8)); },
                ThrowsMessage<InvalidInput>(HasSubstr("9 x 8")));
    EXPECT_THAT([] { classify_ground(Photo(9, 9), {}, FloatRaster(9, 9, 95.0F)); },
                ThrowsMessage<InvalidInput>(HasSubstr("holds 95")));
    GroundOptions options;
    options.superpixels.size_px = 2;
    EXPECT_THAT([&] { classify_ground(Photo(9, 9), options); },
                ThrowsMessage<InvalidOption>(HasSubstr("superpixel-size is 2")));
}

TEST(GroundMosaic, IsTheSameForTheSameSeedAndAnyNumberOfThreads) {
    const auto run = [](int n_threads) {
        const ThreadLimit limit(n_threads);
        return test::make_ground_mosaic(80, 80, 4);
    };
    const auto one = run(1);
    const auto four = run(4);
    EXPECT_EQ(one.photo, four.photo);
    EXPECT_EQ(one.classes, four.classes);
}

}  // namespace
}  // namespace scree::vision
