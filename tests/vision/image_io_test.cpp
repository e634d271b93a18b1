#include "vision/image_io.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"

#include <fstream>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

Photo gradient(int width, int height) {
    Photo photo(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            photo(x, y) = {static_cast<std::uint8_t>(3 * x), static_cast<std::uint8_t>(5 * y), 77};
    return photo;
}

TEST(ImageIo, PngKeepsEveryByte) {
    const test::TempDir dir;
    const Photo photo = gradient(31, 17);
    write_png(dir / "a.png", photo);
    EXPECT_EQ(read_photo(dir / "a.png").pixels, photo);
}

// A reader that honours a tag for colours would bend normals.
TEST(ImageIo, DataCarriesNoColourSpace) {
    const test::TempDir dir;
    const Photo normals = gradient(31, 17);
    write_data_png(dir / "data.png", normals);
    write_png(dir / "colours.png", normals);
    EXPECT_EQ(read_photo(dir / "data.png").pixels, normals);
    const std::string data = read_whole_file(dir / "data.png", 100'000);
    for (const char* tag : {"sRGB", "gAMA", "iCCP", "cHRM"})
        EXPECT_EQ(data.find(tag), std::string::npos) << tag;
    EXPECT_NE(read_whole_file(dir / "colours.png", 100'000).find("sRGB"), std::string::npos);
}

TEST(ImageIo, LabelsKeepSixteenBits) {
    const test::TempDir dir;
    LabelMap labels(5, 4);
    labels(3, 2) = 65535;
    labels(0, 0) = 300;
    write_labels(dir / "l.png", labels);
    EXPECT_EQ(read_labels(dir / "l.png"), labels);
    EXPECT_THROW(
        {
            write_png(dir / "rgb.png", gradient(4, 4));
            read_labels(dir / "rgb.png");
        },
        InvalidInput);
}

TEST(ImageIo, HeightsCarryMetresThroughBothFormats) {
    const test::TempDir dir;
    HeightImage heights{FloatRaster(8, 6), 0.0025};
    for (int x = 0; x < 8; ++x)
        heights.metres(x, 3) = 0.01F * static_cast<float>(x) - 0.02F;
    write_heights_exr(dir / "h.exr", heights);
    write_heights_png(dir / "h.png", heights);
    const HeightImage exr = read_heights(dir / "h.exr");
    const HeightImage png = read_heights(dir / "h.png");
    EXPECT_EQ(exr.metres, heights.metres);
    EXPECT_NEAR(exr.metres_per_pixel, 0.0025, 1e-9);
    EXPECT_NEAR(png.metres_per_pixel, 0.0025, 1e-9);
    for (std::size_t i = 0; i < heights.metres.size(); ++i)
        EXPECT_NEAR(png.metres.data()[i], heights.metres.data()[i], 1e-6);
}

TEST(ImageIo, RgbaKeepsEveryValueUnderAnyAlpha) {
    const test::TempDir dir;
    for (const int bits : {8, 16}) {
        const int high = (1 << bits) - 1;
        RgbaImage picture{Raster<glm::u16vec4>(16, 9), bits};
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 16; ++x)  // alpha from nothing to full over the same colours
                picture.values(x, y) = {high - x, 7 * y, high / 3, x == 0 ? 0 : high * x / 15};
        write_rgba_png(dir / "a.png", picture);
        EXPECT_EQ(read_rgba(dir / "a.png"), picture) << bits;
        EXPECT_THAT([&] { read_rgba(dir / "a.png", {.max_pixels = 100}); },
                    testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("16 x 9")));
    }
    write_png(dir / "rgb.png", gradient(4, 4));
    EXPECT_THAT([&] { read_rgba(dir / "rgb.png"); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("3 channels of uint8")));
}

TEST(ImageIo, PlanesKeepNamesAndBits) {
    const test::TempDir dir;
    std::vector<NamedPlane> planes{{"depth", FloatRaster(5, 3, 0.1F)}, {"A", FloatRaster(5, 3)}};
    planes[0].values(4, 2) = 1e-30F;
    planes[1].values(1, 1) = -3.0F;
    write_planes_exr(dir / "p.exr", planes);
    const auto again = read_planes(dir / "p.exr");
    ASSERT_EQ(again.size(), 2U);
    for (const NamedPlane& plane : again)
        EXPECT_EQ(plane.values, planes[plane.name == "A" ? 1 : 0].values) << plane.name;
    const std::string bytes = read_whole_file(dir / "p.exr", 100'000);
    write_planes_exr(dir / "p.exr", planes);
    EXPECT_EQ(read_whole_file(dir / "p.exr", 100'000), bytes);
    planes[1].values = FloatRaster(4, 3);
    EXPECT_THROW(write_planes_exr(dir / "q.exr", planes), InvalidInput);
    write_png(dir / "rgb.png", gradient(4, 4));
    EXPECT_THROW(read_planes(dir / "rgb.png"), InvalidInput);
}

TEST(ImageIo, HeightsSayWhetherTheyAreMetres) {
    const test::TempDir dir;
    write_heights_png(dir / "h.png", {FloatRaster(8, 6), 0.0025});
    write_png(dir / "grey.png", Raster<std::uint8_t>(8, 6));
    EXPECT_TRUE(read_heights(dir / "h.png").in_metres);
    EXPECT_FALSE(read_heights(dir / "grey.png").in_metres);
}

TEST(ImageIo, PixelLimitIsCheckedFirst) {
    const test::TempDir dir;
    write_png(dir / "a.png", gradient(31, 17));
    EXPECT_THAT([&] { read_photo(dir / "a.png", {.max_pixels = 100}); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("31 x 17")));
}

TEST(ImageIo, ErrorsNameTheFile) {
    const test::TempDir dir;
    std::ofstream(dir / "empty.png").flush();
    std::ofstream(dir / "text.png") << "this is no picture";
    for (const char* name : {"missing.png", "empty.png", "text.png"})
        EXPECT_THAT([&] { read_photo(dir / name); },
                    testing::ThrowsMessage<IoError>(testing::HasSubstr(name)));
    EXPECT_THROW(read_photo(dir.path()), IoError);
    EXPECT_THROW(write_png(dir / "no/such/folder/a.png", gradient(2, 2)), IoError);
}

TEST(ImageIo, JpegIsEncodedInMemory) {
    const auto bytes = encode_jpeg(gradient(40, 30), 90);
    ASSERT_GT(bytes.size(), 100U);
    EXPECT_EQ(bytes[0], 0xFF);
    EXPECT_EQ(bytes[1], 0xD8);
}

}  // namespace
}  // namespace scree::vision
