#include "terrain/grid/soil_field.h"

#include "base/error.h"
#include "ground_fixtures.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SoilField, IsTheSameEverywhereForOneSoil) {
    const SoilField field(kMud);
    SoilTile tile;
    field.fill({-5, 1000, 3, 2}, tile);
    ASSERT_EQ(tile.repose.size(), 6U);
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(tile.tan_repose.data()[i], std::tan(0.2617993878), 1e-6);
        EXPECT_NEAR(tile.repose.data()[i], 0.2617993878, 1e-6);
        EXPECT_EQ(tile.mobility.data()[i], 0.25F);
        EXPECT_EQ(tile.diffusion.data()[i], 0.08F);
        EXPECT_EQ(tile.compaction.data()[i], 0.0F);
    }
    EXPECT_EQ(field.greatest_diffusion(), 0.08);
    EXPECT_EQ(field.id_at(7, -7), 0);
}

TEST(SoilField, TakesTheNearestMapCellAndCarriesTheRimOutwards) {
    DescriptionMap map = test::patchwork(4, 2, 1);
    map.cell_size = 2.0;
    map.ids(0, 0) = 0;
    map.ids(1, 0) = 1;
    map.ids(3, 1) = 2;
    const SoilField field(map, 1.0);  // two grid cells to a map cell
    EXPECT_EQ(field.id_at(1, 1), 0);
    EXPECT_EQ(field.id_at(2, 0), 1);
    EXPECT_EQ(field.id_at(3, 1), 1);
    EXPECT_EQ(field.id_at(7, 3), 2);
    EXPECT_EQ(field.id_at(100, 100), 2);
    SoilTile tile;
    field.fill({2, 0, 1, 1}, tile);
    EXPECT_EQ(tile.diffusion(0, 0), 0.08F);
    EXPECT_EQ(tile.compaction(0, 0), 0.3F);
}

TEST(SoilField, PlanesReplaceTheMaterialsValues) {
    DescriptionMap map = test::patchwork(3, 1, 1);
    map.repose = FloatRaster(3, 1, 0.5F);
    map.mobility = FloatRaster(3, 1, 2.0F);
    map.diffusion = FloatRaster(3, 1, 0.1F);
    map.diffusion(1, 0) = 0.125F;
    const SoilField field(map, 1.0);
    SoilTile tile;
    field.fill({0, 0, 3, 1}, tile);
    EXPECT_NEAR(tile.tan_repose(2, 0), std::tan(0.5), 1e-6);
    EXPECT_EQ(tile.mobility(2, 0), 2.0F);
    EXPECT_EQ(tile.diffusion(1, 0), 0.125F);
    EXPECT_EQ(field.greatest_diffusion(), 0.125);
}

TEST(SoilField, GreatestDiffusionIsOfMaterialsThatOccur) {
    DescriptionMap map = test::patchwork(3, 3, 1);
    map.ids = Raster<std::uint8_t>(3, 3, 1);
    EXPECT_EQ(SoilField(map, 1.0).greatest_diffusion(), 0.08);
}

TEST(SoilFieldErrors, NameTheCellAndTheId) {
    DescriptionMap map = test::patchwork(4, 4, 1);
    map.ids(2, 3) = 77;
    EXPECT_THAT([&] { SoilField(map, 1.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("cell (2, 3) has id 77")));
    map = test::patchwork(4, 4, 1);
    map.diffusion = FloatRaster(4, 3);
    EXPECT_THAT([&] { SoilField(map, 1.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("diffusion has 4 x 3 cells")));
    map.diffusion = FloatRaster(4, 4, 0.1F);
    map.diffusion(1, 2) = -0.1F;
    EXPECT_THAT([&] { SoilField(map, 1.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("diffusion in cell (1, 2)")));
    map.diffusion(1, 2) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(SoilField(map, 1.0), InvalidInput);
    map = test::patchwork(4, 4, 1);
    map.materials[1].id = 0;
    EXPECT_THAT([&] { SoilField(map, 1.0); }, ThrowsMessage<InvalidInput>(HasSubstr("same id 0")));
    map.materials[1].id = 256;
    EXPECT_THROW(SoilField(map, 1.0), InvalidInput);
    map = test::patchwork(4, 4, 1);
    map.cell_size = 0.0;
    EXPECT_THROW(SoilField(map, 1.0), InvalidInput);
    EXPECT_THROW(SoilField(test::patchwork(4, 4, 1), -1.0), InvalidInput);
    EXPECT_THROW(SoilField(DescriptionMap{}, 1.0), InvalidInput);
    EXPECT_THROW(SoilField(Soil{.diffusion = -1}), InvalidOption);
}

}  // namespace
}  // namespace scree::terrain
