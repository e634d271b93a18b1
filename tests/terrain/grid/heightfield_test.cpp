#include "terrain/grid/heightfield.h"

#include "base/error.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

Heightfield plane(int width, int height) {
    Heightfield field{FloatRaster(width, height), 0.5};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            field.heights(x, y) = static_cast<float>(2 * x + 3 * y);
    return field;
}

TEST(Heightfield, GivesAPlaneExactlyBetweenCentres) {
    const Heightfield field = plane(5, 4);
    for (const double x : {0.25, 0.7, 1.3, 2.25})
        for (const double z : {0.25, 0.6, 1.75})
            EXPECT_NEAR(height_at(field, x, z), 2 * (x / 0.5 - 0.5) + 3 * (z / 0.5 - 0.5), 1e-5);
}

TEST(Heightfield, CarriesTheRimOutwards) {
    const Heightfield field = plane(5, 4);
    EXPECT_EQ(height_at(field, -10, -10), field.heights(0, 0));
    EXPECT_EQ(height_at(field, 100, 100), field.heights(4, 3));
}

TEST(HeightfieldErrors, NameTheCell) {
    Heightfield field = plane(5, 4);
    field.heights(3, 2) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT([&] { check_heightfield(field); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("cell (3, 2)")));
    field = plane(5, 4);
    field.cell_size = 0;
    EXPECT_THROW(check_heightfield(field), InvalidInput);
    EXPECT_THROW(check_heightfield({FloatRaster(1, 9), 1.0}), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
