#include "terrain/view/material_look.h"

#include "base/error.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

DescriptionMap two_materials() {
    DescriptionMap map;
    map.ids = Raster<std::uint8_t>(2, 1);
    map.materials.resize(2);
    map.materials[0].name = "sand";
    map.materials[1].name = "mud";
    map.materials[1].id = 1;
    map.materials[1].soil = kMud;
    return map;
}

TEST(MaterialLooks, WithoutPicturesTellMaterialsApart) {
    const auto looks = load_looks(two_materials());
    ASSERT_EQ(looks.size(), 2U);
    EXPECT_NE(looks[0].colour, looks[1].colour);
    EXPECT_LT(looks[1].roughness, looks[0].roughness);  // wet soil shines
    EXPECT_TRUE(looks[0].albedo.empty());
}

TEST(MaterialLooks, AreReadFromTheMaterialsFiles) {
    const scree::test::TempDir dir;
    DescriptionMap map = two_materials();
    MaterialTextures& textures = map.materials[1].textures;
    textures.albedo = dir / "albedo.png";
    textures.displacement = dir / "height.png";
    textures.size_m = 0.7;
    textures.displacement_m = 0.02;
    vision::write_png(textures.albedo, Photo(3, 2, {10, 20, 30}));
    vision::write_png(textures.displacement, Raster<std::uint8_t>(4, 4, 255));
    const auto looks = load_looks(map);
    EXPECT_TRUE(looks[0].albedo.empty());
    EXPECT_EQ(looks[1].albedo(2, 1), glm::u8vec3(10, 20, 30));
    EXPECT_FLOAT_EQ(looks[1].displacement(3, 3), 0.02F);
    EXPECT_EQ(looks[1].size_m, 0.7);
}

TEST(MaterialLooks, ErrorsNameTheMaterialAndTheFile) {
    DescriptionMap map = two_materials();
    map.materials[1].textures.albedo = "/nowhere/mud.png";
    EXPECT_THAT([&] { load_looks(map); },
                testing::ThrowsMessage<IoError>(testing::AllOf(
                    testing::HasSubstr("material 'mud'"), testing::HasSubstr("/nowhere/mud.png"))));
}

}  // namespace
}  // namespace scree::terrain
