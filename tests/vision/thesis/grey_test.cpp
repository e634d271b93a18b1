#include "vision/thesis/grey.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

GreyRaster noise(int width, int height, std::uint64_t seed) {
    GreyRaster grey(width, height);
    Rng rng({.seed = seed});
    for (auto& v : grey)
        v = static_cast<std::uint8_t>(rng.below(256));
    return grey;
}

std::uint8_t brute_median(const GreyRaster& grey, int x, int y, int kernel) {
    std::vector<std::uint8_t> values;
    for (int v = y - kernel / 2; v <= y + kernel / 2; ++v)
        for (int u = x - kernel / 2; u <= x + kernel / 2; ++u)
            values.push_back(
                grey(std::clamp(u, 0, grey.width() - 1), std::clamp(v, 0, grey.height() - 1)));
    std::nth_element(values.begin(), values.begin() + kernel * kernel / 2, values.end());
    return values[static_cast<std::size_t>(kernel * kernel / 2)];
}

TEST(Grey, GreyStaysGreyAndWeightsAreRec601) {
    for (int v = 0; v < 256; ++v)
        EXPECT_EQ(grey_of(Photo(1, 1, glm::u8vec3(static_cast<std::uint8_t>(v))))(0, 0), v);
    EXPECT_EQ(grey_of(Photo(1, 1, {255, 0, 0}))(0, 0), 76);
    EXPECT_EQ(grey_of(Photo(1, 1, {0, 255, 0}))(0, 0), 150);
    EXPECT_EQ(grey_of(Photo(1, 1, {0, 0, 255}))(0, 0), 29);
}

TEST(Median, EqualsBruteForceForEveryKernel) {
    const GreyRaster grey = noise(37, 29, 3);
    for (const int kernel : {1, 3, 5, 7, 9}) {
        const GreyRaster filtered = median_filtered(grey, kernel);
        for (int y = 0; y < grey.height(); ++y)
            for (int x = 0; x < grey.width(); ++x)
                ASSERT_EQ(filtered(x, y), brute_median(grey, x, y, kernel)) << kernel;
    }
}

TEST(Median, RemovesImpulsesAndLeavesStepEdgesInPlace) {
    GreyRaster step(20, 20, 40);
    for (int y = 0; y < 20; ++y)
        for (int x = 10; x < 20; ++x)
            step(x, y) = 200;
    GreyRaster spoiled = step;
    spoiled(4, 9) = 255;
    spoiled(15, 3) = 0;
    EXPECT_EQ(median_filtered(spoiled, 5), step);
}

TEST(Median, RefusesAnEmptyPicture) {
    EXPECT_THROW(median_filtered(GreyRaster{}, 5), InvalidInput);
}

}  // namespace
}  // namespace scree::vision
