#include "vision/relief_signal.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

Photo grainy(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed});
    Photo photo(width, height);
    for (auto& pixel : photo) {
        const auto v = static_cast<std::uint8_t>(60 + rng.below(120));
        pixel = {v, v, v};
    }
    return photo;
}

FloatRaster stripes(int width, int height) {
    FloatRaster boundary(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            boundary(x, y) = x % 16 == 0 ? 1.0F : 0.0F;
    return boundary;
}

double mean_of(const FloatRaster& values) {
    double sum = 0.0;
    for (const float v : values)
        sum += static_cast<double>(v);
    return sum / static_cast<double>(values.size());
}

TEST(ReliefSignal, LiesBetweenMinusOneAndOneAboutZero) {
    const Photo photo = grainy(120, 90, 1);
    for (const FloatRaster& boundary : {FloatRaster(), stripes(120, 90)}) {
        const FloatRaster signal = relief_signal(photo, boundary, 20.0);
        ASSERT_EQ(signal.width(), 120);
        ASSERT_EQ(signal.height(), 90);
        for (const float s : signal)
            ASSERT_LT(std::abs(s), 1.0F);
        EXPECT_NEAR(mean_of(signal), 0.0, 0.1);
    }
}

TEST(ReliefSignal, DarkCrevicesAndBordersLieLow) {
    Photo photo(96, 96, glm::u8vec3(150));
    for (int y = 0; y < 96; ++y)
        for (int x = 46; x < 49; ++x)
            photo(x, y) = glm::u8vec3(40);
    const FloatRaster dark = relief_signal(photo, {}, 15.0);
    EXPECT_LT(dark(47, 50), -0.7F);
    EXPECT_GT(dark(10, 50), dark(47, 50) + 0.7F);
    const FloatRaster bordered =
        relief_signal(Photo(96, 96, glm::u8vec3(90)), stripes(96, 96), 8.0);
    EXPECT_LT(bordered(48, 40), bordered(56, 40) - 0.5F);
}

TEST(ReliefSignal, AnEvenPictureSaysNothing) {
    for (const unsigned grey : {0U, 128U, 255U}) {
        const Photo photo(40, 30, glm::u8vec3(static_cast<std::uint8_t>(grey)));
        for (const float s : relief_signal(photo, FloatRaster(40, 30, 0.5F), 10.0))
            ASSERT_EQ(s, 0.0F) << grey;
    }
}

TEST(ReliefSignal, ExposureAndSlowLightHardlyMatter) {
    const Photo photo = grainy(128, 128, 3);
    Photo darker = photo;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const double light = 0.5 + 0.3 * x / 128.0;
            const auto v = static_cast<std::uint8_t>(std::lround(light * photo(x, y).x));
            darker(x, y) = {v, v, v};
        }
    const FloatRaster a = relief_signal(photo, {}, 12.0);
    const FloatRaster b = relief_signal(darker, {}, 12.0);
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        off += static_cast<double>(std::abs(a.data()[i] - b.data()[i]));
    EXPECT_LT(off / static_cast<double>(a.size()), 0.12);  // of a range of 2
}

TEST(ReliefSignal, SameBytesOnAnyThreadCount) {
    const Photo photo = grainy(300, 200, 4);
    const FloatRaster boundary = stripes(300, 200);
    for (const double radius : {5.0, 60.0}) {
        const FloatRaster many = relief_signal(photo, boundary, radius);
        const ThreadLimit one(1);
        EXPECT_EQ(many, relief_signal(photo, boundary, radius));
    }
}

TEST(ReliefSignal, SmallestPicturesWork) {
    for (const int size : {1, 2, 3})
        for (const double radius : {1.0, 1e5})
            for (const float s :
                 relief_signal(grainy(size, 4 - size, 5), FloatRaster(size, 4 - size), radius))
                ASSERT_TRUE(std::isfinite(s));
}

TEST(ReliefSignal, RefusesWhatItCannotRead) {
    const Photo photo = grainy(8, 8, 6);
    EXPECT_THROW(relief_signal({}, {}, 10.0), InvalidInput);
    EXPECT_THROW(relief_signal(photo, FloatRaster(8, 7), 10.0), InvalidInput);
    EXPECT_THROW(relief_signal(photo, {}, 0.5), InvalidInput);
    EXPECT_THROW(relief_signal(photo, {}, std::nan("")), InvalidInput);
    FloatRaster bad(8, 8);
    bad(3, 3) = std::numeric_limits<float>::infinity();
    EXPECT_THROW(relief_signal(photo, bad, 10.0), InvalidInput);
}

}  // namespace
}  // namespace scree::vision
