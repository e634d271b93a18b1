#include "terrain/material/map_from_ids.h"

#include "base/error.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"
#include "vision/image_io.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<Material> painted_materials() {
    auto materials = test::three_materials();
    materials[0].colour = glm::u8vec3(200, 180, 120);
    materials[2].colour = glm::u8vec3(90, 90, 90);
    return materials;
}

TEST(MapFromIds, TakesIdsAsTheyAre) {
    const DescriptionMap map = test::random_map(7, 5, 1, false);
    EXPECT_TRUE(test::same_map(map, map_from_ids(map.ids, map.materials, map.cell_size)));
    Raster<std::uint8_t> ids = map.ids;
    ids(6, 4) = 200;
    EXPECT_THAT([&] { map_from_ids(ids, map.materials, 1.0); },
                ThrowsMessage<InvalidInput>(HasSubstr("cell (6, 4) has the id 200")));
}

TEST(MapFromIds, TakesTheNearestColour) {
    Photo painted(3, 1, glm::u8vec3(200, 180, 120));
    painted(1, 0) = {92, 88, 95};
    const DescriptionMap map = map_from_colours(painted, painted_materials(), 0.5);
    EXPECT_EQ(map.ids(0, 0), 0);
    EXPECT_EQ(map.ids(1, 0), 7);
    EXPECT_EQ(map.cell_size, 0.5);
    painted(2, 0) = {255, 0, 0};
    EXPECT_THAT([&] { map_from_colours(painted, painted_materials(), 0.5); },
                ThrowsMessage<InvalidInput>(
                    HasSubstr("pixel (2, 0) has the colour 255, 0, 0, which is 208")));
    EXPECT_NO_THROW(map_from_colours(painted, painted_materials(), 0.5, {.tolerance = 300}));
    EXPECT_THROW(map_from_colours(painted, painted_materials(), 0.5, {.tolerance = -1}),
                 InvalidOption);
    EXPECT_THAT([&] { map_from_colours(painted, test::three_materials(), 0.5); },
                ThrowsMessage<InvalidInput>(HasSubstr("no material has a colour")));
}

TEST(MapFromIds, TellsIdsFromColoursByTheFile) {
    const test::TempDir dir;
    const DescriptionMap map = test::random_map(7, 5, 1, false);
    vision::write_png(dir / "ids.png", map.ids);
    Photo painted(7, 5);
    for (std::size_t i = 0; i < painted.size(); ++i)
        painted.data()[i] =
            map.ids.data()[i] == 0 ? glm::u8vec3(200, 180, 120) : glm::u8vec3(90, 90, 90);
    vision::write_png(dir / "colours.png", painted);
    EXPECT_EQ(read_painted_map(dir / "ids.png", map.materials, 1.0).ids, map.ids);
    const auto coloured = read_painted_map(dir / "colours.png", painted_materials(), 1.0);
    for (std::size_t i = 0; i < painted.size(); ++i)
        EXPECT_EQ(coloured.ids.data()[i], map.ids.data()[i] == 0 ? 0 : 7);
}

}  // namespace
}  // namespace scree::terrain
