#include "terrain/view/look_layers.h"

#include "base/error.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

MaterialLook waves(int side) {
    MaterialLook look;
    look.size_m = 2.0;
    look.displacement = FloatRaster(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            look.displacement(x, y) =
                0.3F + 0.1F * static_cast<float>(std::sin(6.283185307 * (x + 0.5) / side));
    return look;
}

TEST(LookLayers, HeightsStandAboutTheirMeanAndSlopesAreTrue) {
    const std::vector<MaterialLook> looks{waves(64)};
    const LookLayers layers = make_look_layers(looks);
    ASSERT_EQ(layers.side, 64);
    const LookRecord& record = layers.records[0];
    EXPECT_FLOAT_EQ(record.measure.x, 0.5F);
    EXPECT_NEAR(record.measure.y, 0.2F, 1e-3F);
    EXPECT_NEAR(record.measure.z, 0.1F * 3.14159265F, 2e-3F);  // 2 pi a / size
    EXPECT_EQ(record.measure.w, 0.0F);
    for (int x = 0; x < 64; ++x) {
        const std::uint8_t* texel = &layers.detail[static_cast<std::size_t>(4 * (64 * 20 + x))];
        const double phase = 6.283185307 * (x + 0.5) / 64;
        EXPECT_NEAR((texel[0] - 128) / 127.0, std::cos(phase), 0.02);
        EXPECT_EQ(texel[1], 128);
        EXPECT_NEAR(texel[2] / 255.0 - 0.5, 0.5 * std::sin(phase), 0.01);
    }
}

TEST(LookLayers, HollowsSeeLessSkyThanCrests) {
    const std::vector<MaterialLook> looks{waves(96)};
    const LookLayers layers = make_look_layers(looks);
    const auto open_at = [&](int x) {
        return layers.detail[static_cast<std::size_t>(4 * x * layers.side / 96 + 3)];
    };
    EXPECT_EQ(open_at(24), 255);
    EXPECT_LT(open_at(72), 255);
}

TEST(LookLayers, PicturesKeepTheirColourWhateverTheSize) {
    MaterialLook even;
    even.albedo = Photo(37, 20, {200, 100, 50});
    MaterialLook checks;  // black and white by the pixel: grey of half the light when shrunk
    checks.albedo = Photo(4096, 2);
    for (int x = 0; x < 4096; ++x)
        for (int y = 0; y < 2; ++y)
            checks.albedo(x, y) = (x + y) % 2 == 0 ? glm::u8vec3(255) : glm::u8vec3(0);
    const std::vector<MaterialLook> looks{even, checks};
    const LookLayers layers = make_look_layers(looks);
    ASSERT_EQ(layers.side, 1024);
    EXPECT_EQ(layers.records[0].measure.w, 1.0F);
    const std::size_t n = std::size_t{4} * 1024 * 1024;
    for (const std::size_t at : {std::size_t{0}, n / 2, n - 4}) {
        EXPECT_EQ(layers.albedo[at], 200);
        EXPECT_EQ(layers.albedo[at + 1], 100);
        EXPECT_EQ(layers.albedo[at + 2], 50);
        EXPECT_NEAR(layers.albedo[n + at], 188, 1);
    }
}

TEST(LookLayers, NormalMapsGiveSlopesInTheGroundsFrame) {
    MaterialLook look;
    look.normal = Photo(8, 8, {191, 128, 237});  // leans to +x: the ground falls towards +x
    const std::vector<MaterialLook> looks{look};
    const LookLayers layers = make_look_layers(looks);
    EXPECT_LT(layers.detail[0], 128);
    EXPECT_EQ(layers.detail[1], 128);
    EXPECT_NEAR((layers.detail[0] - 128) / 127.0 * double{layers.records[0].measure.z},
                -(63.0 / 127.5) / (237.0 / 127.5 - 1.0), 0.02);
}

TEST(LookLayers, ShrinkToTheBytesAllowed) {
    MaterialLook look;
    look.albedo = Photo(512, 512);
    const std::vector<MaterialLook> looks(4, look);
    EXPECT_EQ(make_look_layers(looks, std::size_t{4} * 12 * 256 * 256).side, 256);
}

TEST(LookLayersErrors, NameTheLook) {
    std::vector<MaterialLook> looks(2);
    looks[1].size_m = 0.0;
    EXPECT_THAT([&] { make_look_layers(looks); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("look 1 repeats")));
    looks[1].size_m = 1.0;
    looks[1].displacement = FloatRaster(2, 2, std::numeric_limits<float>::quiet_NaN());
    EXPECT_THROW(make_look_layers(looks), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
