#include "vision/classical/light_pyramid.h"

#include "base/error.h"
#include "testdata/synthetic_photo.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

constexpr int kMargin = LightLevel::kMargin;

TEST(LightPyramid, HalvesAndPads) {
    const LightPyramid pyramid = light_pyramid(Photo(37, 21, {10, 20, 30}));
    EXPECT_EQ(pyramid.fine[0].width, 48);
    EXPECT_EQ(pyramid.fine[0].height, 32);
    EXPECT_EQ(pyramid.fine[1].width, 24);
    ASSERT_EQ(pyramid.coarse.size(), 4U);
    int width = pyramid.fine[1].width;
    for (const auto* phases = &pyramid.coarse; !phases->empty(); phases = &phases->back().coarser) {
        width /= 2;
        for (const PhasedLevel& phase : *phases) {
            EXPECT_EQ(phase.level.width, width);
            EXPECT_EQ(phase.level.grey.width(), width + 2 * kMargin);
        }
    }
    EXPECT_EQ(width, 48 / 16);
}

TEST(LightPyramid, PlainPictureIsZero) {
    const LightPyramid pyramid = light_pyramid(Photo(64, 48, {90, 140, 200}));
    for (const LightLevel* level : {&pyramid.fine[0], &pyramid.fine[1], &pyramid.coarse[3].level})
        for (const auto* plane : {&level->grey, &level->red_green, &level->yellow_blue})
            for (const float v : *plane)
                EXPECT_NEAR(v, 0.0F, 1e-3F);
}

TEST(LightPyramid, PhasesMatchWhenThePictureIsShifted) {
    const auto made = test::make_synthetic_photo({.width = 256, .height = 192, .n_rocks = 60});
    Photo cropped(256, 190);
    std::copy(made.photo.row(2), made.photo.row(2) + cropped.size(), cropped.begin());
    const LightPyramid whole = light_pyramid(made.photo), cut = light_pyramid(cropped);
    const auto& a = whole.coarse[2].level;  // one row of level 1 later
    const auto& b = cut.coarse[0].level;
    ASSERT_EQ(whole.coarse[2].dy, 1);
    for (int y = 20 + kMargin; y < 40 + kMargin; ++y)
        for (int x = kMargin; x < kMargin + 60; ++x)
            ASSERT_NEAR(a.luma(x, y), b.luma(x, y), 1e-6F);
}

TEST(LightPyramid, ForgetsBrightnessAndContrast) {
    const auto made = test::make_synthetic_photo({.width = 160, .height = 120, .n_rocks = 40});
    Photo dim = made.photo;
    for (auto& c : dim)
        c = glm::u8vec3(60.0F + 0.5F * glm::vec3(c));
    const auto a = light_pyramid(made.photo), b = light_pyramid(dim);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < a.fine[0].grey.size(); ++i) {
        difference += std::abs(a.fine[0].grey.data()[i] - b.fine[0].grey.data()[i]);
        size += std::abs(a.fine[0].grey.data()[i]);
    }
    EXPECT_LT(difference, 0.12 * size) << "what is left is the floor of the spread";
}

TEST(LightPyramid, EmptyPhotographIsRefused) {
    EXPECT_THAT([] { light_pyramid(Photo()); },
                testing::ThrowsMessage<InvalidInput>("the photograph has no pixels"));
}

}  // namespace
}  // namespace scree::vision
