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
    const auto legend = legend_colours(map.materials);
    const auto slots = slots_of_ids(map.materials);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x)
            EXPECT_EQ(picture(5 * x + 3, 5 * y + 3),
                      legend[static_cast<std::size_t>(slots[map.ids(x, y)])]);
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

TEST(DescriptionPicture, TellsMaterialsOfOneColourApart) {
    auto materials = test::three_materials();
    materials[0].colour = materials[2].colour = glm::u8vec3(80, 80, 80);
    const auto legend = legend_colours(materials);
    EXPECT_EQ(legend[0], glm::u8vec3(80, 80, 80));
    EXPECT_EQ(legend[1], material_colour(materials[1]));
    EXPECT_NE(legend[2], legend[0]);
    EXPECT_NE(legend[2], legend[1]);
}

TEST(DescriptionPicture, ChannelsAreGrey) {
    DescriptionMap map = test::random_map(2, 1, 1, false);
    map.ids(0, 0) = 3;
    map.ids(1, 0) = 7;
    const auto repose = channel_picture(map, MapChannel::Repose);
    EXPECT_EQ(repose(0, 0), 43);   // 15 of 90 degrees
    EXPECT_EQ(repose(1, 0), 108);  // 38 of 90 degrees
    const auto mobility = channel_picture(map, MapChannel::Mobility);
    EXPECT_EQ(mobility(0, 0), 80);  // 0.25 of 0.8
    EXPECT_EQ(mobility(1, 0), 255);
    map.diffusion = FloatRaster(2, 1);
    EXPECT_EQ(channel_picture(map, MapChannel::Diffusion), Raster<std::uint8_t>(2, 1));
}

TEST(DescriptionPicture, SharesAddUp) {
    DescriptionMap map = test::random_map(4, 1, 1, false);
    map.ids = Raster<std::uint8_t>(4, 1);
    map.ids(3, 0) = 7;
    EXPECT_THAT(material_shares(map), testing::ElementsAre(0.75, 0.0, 0.25));
}

}  // namespace
}  // namespace scree::terrain
