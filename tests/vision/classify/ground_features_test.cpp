#include "vision/classify/ground_features.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

std::size_t index_of(std::string_view name) {
    return static_cast<std::size_t>(
        std::find(kGroundFeatureNames.begin(), kGroundFeatureNames.end(), name) -
        kGroundFeatureNames.begin());
}

template <class Lightness>
GroundFeatures middle_features(const Lightness& lightness) {
    Raster<glm::vec3> lab(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            lab(x, y) = {static_cast<float>(lightness(x, y)), 5.0F, -12.0F};
    Superpixels pieces{Raster<std::int32_t>(96, 96), 2};
    for (int y = 40; y < 56; ++y)
        for (int x = 40; x < 56; ++x)
            pieces.ids(x, y) = 1;
    return ground_features(lab, pieces)[1];
}

TEST(GroundFeatures, AreNamedOnce) {
    auto names = kGroundFeatureNames;
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
    EXPECT_LT(index_of("dark-share"), kGroundFeatures);
}

TEST(GroundFeatures, OfAnEvenGroundAreItsColourAndNothingElse) {
    const GroundFeatures features = middle_features([](int, int) { return 60.0; });
    EXPECT_NEAR(features[index_of("lightness")], 60, 1e-3);
    EXPECT_NEAR(features[index_of("red-green")], 5, 1e-3);
    EXPECT_NEAR(features[index_of("yellow-blue")], -12, 1e-3);
    EXPECT_NEAR(features[index_of("chroma")], 13, 1e-3);
    EXPECT_NEAR(features[index_of("detail-2px")], std::log(0.05), 0.01);
    EXPECT_NEAR(features[index_of("dark-share")], 0, 1e-6);
}

TEST(GroundFeatures, GrainSizeGrowsWithTheWavelength) {
    double before = -1.0;
    for (const double wavelength : {4.0, 8.0, 16.0, 32.0}) {
        const GroundFeatures features = middle_features([wavelength](int x, int y) {
            return 50 + 20 * std::sin(x * 6.2832 / wavelength) * std::sin(y * 6.2832 / wavelength);
        });
        const double size = static_cast<double>(features[index_of("grain-size")]);
        EXPECT_GT(size, before + 0.4);
        before = size;
    }
}

TEST(GroundFeatures, TellOneDirectionFromAll) {
    const auto stripes = middle_features([](int x, int) { return 50 + 20 * std::sin(0.8 * x); });
    const auto checks = middle_features(
        [](int x, int y) { return 50 + 20 * std::sin(0.8 * x) * std::sin(0.8 * y); });
    EXPECT_GT(stripes[index_of("one-direction")], 0.95F);
    EXPECT_LT(checks[index_of("one-direction")], 0.2F);
}

TEST(GroundFeatures, RareCracksArePeakedAndDark) {
    const auto cracks = middle_features([](int x, int) { return x % 16 == 0 ? 10.0 : 60.0; });
    const auto even = middle_features([](int x, int y) { return (x + y) % 2 == 0 ? 40.0 : 60.0; });
    EXPECT_GT(cracks[index_of("peakedness-fine")], even[index_of("peakedness-fine")] + 1.0F);
    EXPECT_NEAR(cracks[index_of("dark-share")], 1.0 / 16, 0.03);
    EXPECT_LT(cracks[index_of("skewness")], -1.0F);
}

}  // namespace
}  // namespace scree::vision
