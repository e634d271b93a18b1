#include "vision/learned/level_picture.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(Halved, TakesMeansAndRepeatsTheLastOfAnOddSide) {
    Photo photo(3, 1);
    photo(0, 0) = {10, 0, 0};
    photo(1, 0) = {20, 0, 0};
    photo(2, 0) = {40, 0, 255};
    const Photo half = halved(photo);
    ASSERT_EQ(half.width(), 2);
    ASSERT_EQ(half.height(), 1);
    EXPECT_EQ(half(0, 0), glm::u8vec3(15, 0, 0));
    EXPECT_EQ(half(1, 0), glm::u8vec3(40, 0, 255));
    EXPECT_EQ(halved(Photo(1, 1, {7, 8, 9})), Photo(1, 1, glm::u8vec3(7, 8, 9)));
}

TEST(Doubled, KeepsAFlatPicture) {
    EXPECT_EQ(doubled(Photo(5, 7, {50, 60, 70})), Photo(10, 14, glm::u8vec3(50, 60, 70)));
}

TEST(LevelPicture, IsPaddedByMirroring) {
    Photo photo(50, 40);
    for (int x = 0; x < 50; ++x)
        for (int y = 0; y < 40; ++y)
            photo(x, y) = glm::u8vec3(static_cast<std::uint8_t>(4 * x));
    const LevelPicture level = level_picture(photo);
    EXPECT_EQ(level.width, 50);
    ASSERT_EQ(level.padded.width(), 64);
    ASSERT_EQ(level.padded.height(), 64);
    EXPECT_EQ(level.padded(50, 3), photo(48, 3));
    EXPECT_EQ(level.mean.width(), 10);
    const LevelPicture small = level_picture(Photo(3, 3, {1, 2, 3}));
    EXPECT_EQ(small.padded(31, 31), glm::u8vec3(1, 2, 3));
}

// Black and white stripes of 4 px: light of mean 1/2 and spread 1/2 everywhere.
TEST(FillInput, LosesMeanAndSpread) {
    Photo photo(128, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 128; ++x)
            photo(x, y) = glm::u8vec3(x / 4 % 2 == 0 ? 0 : 255);
    const LevelPicture level = level_picture(photo);
    std::vector<float> planes;
    fill_input(level, {32, 64}, {0, 96}, planes);
    ASSERT_EQ(planes.size(), std::size_t{3 * 64 * 96});
    for (std::size_t i = 0; i < planes.size(); ++i)
        ASSERT_NEAR(planes[i], (i / 4 % 2 == 0 ? -0.5 : 0.5) / 0.54, 1e-4);
}

}  // namespace
}  // namespace scree::vision
