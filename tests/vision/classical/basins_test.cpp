#include "vision/classical/basins.h"

#include "base/error.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(Basins, TwoPitsGiveTwoBasinsPartedAtTheRidge) {
    FloatRaster relief(21, 9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 21; ++x)
            relief(x, y) =
                static_cast<float>(std::min(std::abs(x - 4), std::abs(x - 16)) + std::abs(y - 4));
    const BasinMap basins = find_basins(relief, Mask(21, 9, 1));
    EXPECT_EQ(basins.count, 2);
    EXPECT_EQ(basins.labels(0, 0), basins.labels(9, 8));
    EXPECT_EQ(basins.labels(11, 0), basins.labels(20, 8));
    EXPECT_NE(basins.labels(4, 4), basins.labels(16, 4));
}

TEST(Basins, EveryMaskedPixelAndNoOtherBelongsToOne) {
    FloatRaster relief(40, 30);
    Mask mask(40, 30, 1);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            relief(x, y) = static_cast<float>((x * 7919 + y * 104729) % 101);
            mask(x, y) = (x / 5 + y / 4) % 3 != 0 ? 1 : 0;
        }
    const BasinMap basins = find_basins(relief, mask);
    std::vector<bool> used(static_cast<std::size_t>(basins.count), false);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        const int label = basins.labels.data()[i];
        EXPECT_EQ(label == kNoBasin, mask.data()[i] == 0);
        if (label != kNoBasin)
            used[static_cast<std::size_t>(label)] = true;
    }
    EXPECT_THAT(used, testing::Each(true)) << "numbers have no holes";
}

TEST(Basins, PlainIsOneBasin) {
    EXPECT_EQ(find_basins(FloatRaster(50, 20, 0.5F), Mask(50, 20, 1)).count, 1);
}

TEST(Basins, EmptyMaskGivesNone) {
    EXPECT_EQ(find_basins(FloatRaster(5, 5, 0.5F), Mask(5, 5, 0)).count, 0);
}

TEST(Basins, SizesMustAgree) {
    EXPECT_THAT([] { find_basins(FloatRaster(5, 5), Mask(5, 6)); },
                testing::ThrowsMessage<InvalidInput>("the relief is 5 x 5 but its mask 5 x 6"));
}

}  // namespace
}  // namespace scree::vision
