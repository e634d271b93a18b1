#include "base/raster.h"

#include <gmock/gmock.h>

namespace scree {
namespace {

TEST(Raster, StoresRowAfterRow) {
    Raster<int> raster(3, 2, 4);
    raster(2, 1) = 9;
    EXPECT_EQ(raster.size(), 6U);
    EXPECT_EQ(raster.data()[5], 9);
    EXPECT_EQ(raster.row(1)[2], 9);
    EXPECT_EQ(raster(0, 0), 4);
}

TEST(Raster, KnowsWhatItContains) {
    const Raster<int> raster(3, 2);
    EXPECT_TRUE(raster.contains(2, 1));
    EXPECT_FALSE(raster.contains(3, 1));
    EXPECT_FALSE(raster.contains(0, -1));
    EXPECT_TRUE(Raster<int>{}.empty());
}

}  // namespace
}  // namespace scree
