#include "terrain/material/texture_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/material/map_check.h"
#include "terrain/material/repeating_texture.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// One row of sand and pebbles, 4 m each.
DescriptionMap two_halves() {
    DescriptionMap map;
    map.materials = test::three_materials();
    map.ids = Raster<std::uint8_t>(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 4; x < 8; ++x)
            map.ids(x, y) = 7;
    return map;
}

std::vector<MaterialPictures> plain_pictures() {
    std::vector<MaterialPictures> pictures(3);
    pictures[0].albedo = Photo(4, 4, glm::u8vec3(200, 10, 0));
    pictures[2].albedo = Photo(4, 4, glm::u8vec3(0, 10, 200));
    pictures[2].displacement = FloatRaster(4, 4, 0.5F);
    return pictures;
}

TEST(TextureBake, ShowsEachMaterialAndBlendsBetweenThem) {
    const DescriptionMap map = two_halves();
    const BakedGround baked = bake_textures(map, plain_pictures(), {.size = 64});
    ASSERT_EQ(baked.albedo.width(), 64);
    ASSERT_EQ(baked.albedo.height(), 64);
    EXPECT_EQ(baked.displacement.metres_per_pixel, 0.125);
    EXPECT_EQ(baked.albedo(3, 30), glm::u8vec3(200, 10, 0));
    EXPECT_EQ(baked.albedo(60, 30), glm::u8vec3(0, 10, 200));
    EXPECT_EQ(baked.normal(3, 30), glm::u8vec3(128, 128, 255));
    EXPECT_EQ(baked.displacement.metres(3, 30), 0.0F);
    EXPECT_EQ(baked.displacement.metres(60, 30), 0.5F);
    for (int x = 0; x < 64; ++x) {  // linear from centre to centre of the cells that meet
        const double share = std::clamp((x + 0.5) / 8.0 - 3.5, 0.0, 1.0);
        EXPECT_NEAR(baked.displacement.metres(x, 30), 0.5 * share, 1e-6);
    }
}

TEST(TextureBake, MixesInLinearLight) {
    auto pictures = plain_pictures();
    pictures[0].albedo = Photo(1, 1, glm::u8vec3(0));
    pictures[2].albedo = Photo(1, 1, glm::u8vec3(255));
    const BakedGround baked = bake_textures(two_halves(), pictures, {.size = 9});
    EXPECT_EQ(baked.albedo(4, 4), glm::u8vec3(188));  // a half of the light
}

TEST(TextureBake, PlainMaterialsHaveTheirColour) {
    const DescriptionMap map = two_halves();
    const BakedGround baked = bake_texture_files(map, {.size = 8});
    EXPECT_EQ(baked.albedo(0, 0), material_colour(map.materials[0]));
    EXPECT_EQ(baked.albedo(7, 7), material_colour(map.materials[2]));
}

TEST(TextureBake, TexturesRepeatAtTheirSizeInMetres) {
    DescriptionMap map = two_halves();
    map.ids = Raster<std::uint8_t>(8, 8);
    map.materials[0].textures.size_m = 2.0;
    auto pictures = plain_pictures();
    pictures[0].displacement = FloatRaster(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            pictures[0].displacement(x, y) = static_cast<float>(x + 4 * y);
    const auto baked = bake_textures(map, pictures, {.size = 16});  // a pixel is a texel
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(baked.displacement.metres(x, y), x % 4 + 4 * (y % 4), 1e-4);
}

TEST(TextureBake, FinerTexturesAreAveraged) {
    Raster<float> texels(64, 64);
    double mean = 0.0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            texels(x, y) = static_cast<float>((x * 7 + y * 13) % 11);
            mean += texels(x, y) / 4096.0;
        }
    const RepeatingTexture<float> one(texels, 1.0, 1.0);
    EXPECT_NEAR(one.at(0.3, 0.7), mean, 1e-4);
    const RepeatingTexture<float> thirds(texels, 1.0, 1.0 / 3.0);
    double sum = 0.0;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            sum += thirds.at((x + 0.5) / 3.0, (y + 0.5) / 3.0);
    EXPECT_NEAR(sum / 9.0, mean, 1e-4);
}

TEST(TextureBake, SlopesBecomeNormalsWhereThereAreNone) {
    DescriptionMap map = two_halves();
    map.ids = Raster<std::uint8_t>(8, 8);
    map.materials[0].textures.size_m = 8.0;
    auto pictures = plain_pictures();
    pictures[0].displacement = FloatRaster(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)  // a slope of one along +X, 8 m a repetition
            pictures[0].displacement(x, y) = static_cast<float>(x) * 0.125F;
    const BakedGround with = bake_textures(map, pictures, {.size = 64});
    const double part = -std::sqrt(0.5);
    EXPECT_NEAR(with.normal(30, 30).x, 127.5 * (1.0 + part), 1.5);
    EXPECT_NEAR(with.normal(30, 30).z, 127.5 * (1.0 - part), 1.5);
    const auto without = bake_textures(map, pictures, {.size = 64, .derive_normals = false});
    EXPECT_EQ(without.normal(30, 30), glm::u8vec3(128, 128, 255));
}

TEST(TextureBake, ReadsDisplacementsInMetresOrInShares) {
    const test::TempDir dir;
    MaterialTextures textures;
    textures.displacement_m = 0.04;
    textures.displacement = dir / "grey.png";
    vision::write_png(textures.displacement, Raster<std::uint8_t>(4, 4, std::uint8_t{255}));
    EXPECT_FLOAT_EQ(read_displacement(textures)(1, 1), 0.04F);
    textures.displacement = dir / "metres.exr";
    vision::write_heights_exr(textures.displacement, {FloatRaster(4, 4, 0.3F), 0.01});
    EXPECT_FLOAT_EQ(read_displacement(textures)(1, 1), 0.3F);
}

TEST(TextureBake, IsTheSameForAnyThreadCountAndEitherShape) {
    DescriptionMap map = test::random_map(20, 9, 2, false);
    for (const bool literal : {false, true}) {
        const auto many =
            bake_textures(map, plain_pictures(), {.size = 100, .literal_hat = literal});
        EXPECT_EQ(many.albedo.height(), 45);
        const ThreadLimit one(1);
        const auto again =
            bake_textures(map, plain_pictures(), {.size = 100, .literal_hat = literal});
        EXPECT_EQ(many.albedo, again.albedo);
        EXPECT_EQ(many.normal, again.normal);
        EXPECT_EQ(many.displacement.metres, again.displacement.metres);
    }
}

TEST(TextureBake, CanBeStopped) {
    struct Stop : Progress {
        void report(std::string_view, double) override {}
        bool cancelled() const override { return true; }
    } stop;
    EXPECT_THROW(bake_textures(two_halves(), plain_pictures(), {.size = 8}, &stop), Cancelled);
}

TEST(TextureBake, SaysWhatIsWrong) {
    DescriptionMap map = two_halves();
    EXPECT_THAT([&] { bake_textures(map, std::vector<MaterialPictures>(2)); },
                ThrowsMessage<InvalidInput>(HasSubstr("pictures of 2 materials, the map has 3")));
    EXPECT_THROW(bake_texture_files(map, {.size = 0}), InvalidOption);
    map.materials[0].textures.albedo = "/no/such/file.png";
    EXPECT_THROW(bake_texture_files(map, {.size = 8}), IoError);
}

}  // namespace
}  // namespace scree::terrain
