#include "terrain/material/map_from_rocks.h"

#include "base/error.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Two cells: three of four pixels rock, one of four.
struct Sample {
    LabelMap labels{4, 2};
    Photo photo{4, 2, glm::u8vec3(10, 20, 30)};
    Sample() {
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {3, 1}}) {
            labels(x, y) = static_cast<std::uint16_t>(5 + x);
            photo(x, y) = {100, 110, static_cast<std::uint8_t>(120 + x)};
        }
    }
};

TEST(MapFromRocks, MixesByTheShareOfRock) {
    const Sample sample;
    const DescriptionMap map =
        map_from_rocks(sample.labels, sample.photo, 0.01, {.pixels_per_cell = 2});
    ASSERT_EQ(map.ids.width(), 2);
    ASSERT_EQ(map.ids.height(), 1);
    EXPECT_EQ(map.ids(0, 0), kRockId);
    EXPECT_EQ(map.ids(1, 0), kMatrixId);
    EXPECT_DOUBLE_EQ(map.cell_size, 0.02);
    EXPECT_NEAR(map.mobility(0, 0), 0.75 * 0.8 + 0.25 * 0.5, 1e-6);
    EXPECT_NEAR(map.diffusion(1, 0), 0.25 * 0.12 + 0.75 * 0.20, 1e-6);
    const double degree = std::numbers::pi / 180.0;
    EXPECT_NEAR(std::tan(map.repose(0, 0)),
                0.75 * std::tan(38 * degree) + 0.25 * std::tan(34 * degree), 1e-6);
    EXPECT_EQ(map.materials[0].colour, glm::u8vec3(10, 20, 30));
    EXPECT_EQ(map.materials[1].colour, glm::u8vec3(100, 110, 121));
}

TEST(MapFromRocks, TakesPicturesThatAreNoMultipleOfTheCell) {
    const Sample sample;
    const auto map = map_from_rocks(sample.labels, sample.photo, 0.01, {.pixels_per_cell = 3});
    ASSERT_EQ(map.ids.width(), 2);
    EXPECT_EQ(map.ids(0, 0), kRockId);  // 3 of 6
    EXPECT_EQ(map.ids(1, 0), kRockId);  // 1 of 2
}

TEST(MapFromRocks, SaysWhatIsWrong) {
    const Sample sample;
    EXPECT_THAT([&] { map_from_rocks(sample.labels, Photo(5, 2), 0.01); },
                ThrowsMessage<InvalidInput>(HasSubstr("4 x 2 pixels, the photograph 5 x 2")));
    EXPECT_THROW(map_from_rocks(sample.labels, sample.photo, 0.0), InvalidInput);
    EXPECT_THROW(map_from_rocks({}, {}, 0.01), InvalidInput);
    EXPECT_THROW(map_from_rocks(sample.labels, sample.photo, 0.01, {.pixels_per_cell = 0}),
                 InvalidOption);
}

TEST(MapFromRocks, TextureIsTheMiddleSquare) {
    Photo photo(5, 3);
    for (int x = 0; x < 5; ++x)
        photo(x, 1) = glm::u8vec3(glm::ivec3(x));
    const Photo square = square_texture(photo);
    ASSERT_EQ(square.width(), 3);
    ASSERT_EQ(square.height(), 3);
    EXPECT_EQ(square(0, 1), glm::u8vec3(1));
    EXPECT_EQ(square(2, 1), glm::u8vec3(3));
}

}  // namespace
}  // namespace scree::terrain
