#include "terrain/material/map_from_classes.h"

#include "base/error.h"
#include "terrain/material/map_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

using vision::GroundClass;

constexpr auto kMudValue = static_cast<std::uint8_t>(GroundClass::Mud);
constexpr auto kGrassValue = static_cast<std::uint8_t>(GroundClass::Grass);

TEST(MapFromClasses, TakesTheClassOfMostPixels) {
    Raster<std::uint8_t> classes(5, 4);  // cells of 2: the last column reaches beyond
    classes(0, 0) = classes(1, 0) = classes(0, 1) = kMudValue;
    classes(4, 2) = classes(4, 3) = kGrassValue;
    const DescriptionMap map = map_from_classes(classes, 0.01, {.pixels_per_cell = 2});
    EXPECT_EQ(map.ids.width(), 3);
    EXPECT_EQ(map.ids.height(), 2);
    EXPECT_DOUBLE_EQ(map.cell_size, 0.02);
    EXPECT_EQ(map.ids(0, 0), kMudValue);
    EXPECT_EQ(map.ids(1, 0), 0);
    EXPECT_EQ(map.ids(2, 1), kGrassValue);
}

TEST(MapFromClasses, IsAValidMapWithThePresets) {
    const DescriptionMap map = map_from_classes(Raster<std::uint8_t>(9, 9, 2), 0.001);
    EXPECT_NO_THROW(check_map(map, "the map"));
    ASSERT_EQ(map.materials.size(), vision::kGroundClasses);
    EXPECT_EQ(map.materials[0].soil, kSand);
    EXPECT_EQ(map.materials[1].soil, kMud);
    EXPECT_EQ(map.materials[2].soil, kPebbles);
    EXPECT_EQ(map.materials[3].name, "rock");
}

TEST(MapFromClassesErrors, NameThePixelAndTheScale) {
    using testing::HasSubstr;
    using testing::ThrowsMessage;
    Raster<std::uint8_t> classes(3, 3);
    classes(2, 1) = 9;
    EXPECT_THAT([&] { map_from_classes(classes, 0.01); },
                ThrowsMessage<InvalidInput>(HasSubstr("pixel (2, 1) holds class 9")));
    classes(2, 1) = 0;
    EXPECT_THAT([&] { map_from_classes(classes, 0.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("scale is 0")));
    EXPECT_THROW(map_from_classes({}, 0.01), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
