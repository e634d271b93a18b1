#include "terrain/material/description_picture.h"

#include "terrain/material/map_check.h"
#include "tests/terrain/material/map_samples.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

TEST(DescriptionPicture, ShowsEveryCellInItsColour) {
    const DescriptionMap map = test::random_map(20, 10, 1, false);
    const Photo picture = description_picture(map, 100);
    ASSERT_EQ(picture.width(), 100);
    ASSERT_EQ(picture.height(), 50);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x)
            for (const Material& material : map.materials)
                if (material.id == map.ids(x, y)) {
                    EXPECT_EQ(picture(5 * x + 3, 5 * y + 3), material_colour(material));
                }
    EXPECT_EQ(description_picture(map, 1).width(), 20);
}

TEST(DescriptionPicture, IsBrighterWhereTheReposeIsSteeper) {
    DescriptionMap map = test::random_map(2, 1, 1, false);
    map.ids = Raster<std::uint8_t>(2, 1);
    map.repose = FloatRaster(2, 1, 0.5F);
    map.repose(1, 0) = 0.7F;
    const Photo picture = description_picture(map, 2);
    EXPECT_LT(int{picture(0, 0).x} + 10, int{picture(1, 0).x});
}

TEST(DescriptionPicture, SharesAddUp) {
    DescriptionMap map = test::random_map(4, 1, 1, false);
    map.ids = Raster<std::uint8_t>(4, 1);
    map.ids(3, 0) = 7;
    EXPECT_THAT(material_shares(map), testing::ElementsAre(0.75, 0.0, 0.25));
}

}  // namespace
}  // namespace scree::terrain
