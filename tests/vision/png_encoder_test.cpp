#include "vision/png_encoder.h"

#include "base/parallel.h"
#include "base/random.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <string_view>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

template <class T>
Raster<T> noise(int width, int height, std::uint64_t most) {
    Raster<T> raster(width, height);
    Rng random({.seed = 5});
    for (T& value : raster)
        value = T(random.below(most + 1));
    return raster;
}

PngPicture grey_of(const LabelMap& raster) {
    return {static_cast<std::size_t>(raster.width()), static_cast<std::size_t>(raster.height()), 1,
            16, raster.data()};
}

struct Size {
    int width, height;
};
class PngSizes : public testing::TestWithParam<Size> {};

TEST_P(PngSizes, ComeBackAsTheyWere) {
    const auto [width, height] = GetParam();
    const test::TempDir dir;
    Photo photo(width, height);
    const auto bytes = noise<std::uint8_t>(3 * width, height, 255);
    for (std::size_t i = 0; i < photo.size(); ++i)
        photo.data()[i] = {bytes.data()[3 * i], bytes.data()[3 * i + 1], bytes.data()[3 * i + 2]};
    write_png(dir / "colours.png", photo);
    EXPECT_EQ(read_photo(dir / "colours.png").pixels, photo);

    const auto grey = noise<std::uint8_t>(width, height, 255);
    write_png(dir / "grey.png", grey);
    const LabelMap read = read_labels(dir / "grey.png");
    EXPECT_TRUE(std::equal(grey.begin(), grey.end(), read.begin(), read.end()));

    const auto labels = noise<std::uint16_t>(width, height, 65535);
    for (const PngFilter filter : {PngFilter::Above, PngFilter::Average}) {
        PngPicture picture = grey_of(labels);
        picture.filter = filter;
        write_whole_file(dir / "labels.png", encode_png(picture));
        EXPECT_EQ(read_labels(dir / "labels.png"), labels);
    }
}
INSTANTIATE_TEST_SUITE_P(Odd, PngSizes,
                         testing::Values(Size{1, 1}, Size{1, 200}, Size{200, 1}, Size{63, 64},
                                         Size{31, 65}, Size{129, 130}));

TEST(PngEncoder, ThreadsDoNotMatter) {
    const auto labels = noise<std::uint16_t>(301, 277, 900);
    const auto many = encode_png(grey_of(labels));
    const ThreadLimit one(1);
    EXPECT_EQ(encode_png(grey_of(labels)), many);
}

TEST(PngEncoder, WritesTextsBeforeThePixels) {
    const LabelMap labels(3, 2);
    PngPicture picture = grey_of(labels);
    picture.texts = {{"scale", "0.5"}};
    const auto file = encode_png(picture);
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const auto at = text.find(std::string_view("tEXtscale\0000.5", 13));
    ASSERT_NE(at, std::string_view::npos);
    EXPECT_LT(at, text.find("IDAT"));
    EXPECT_EQ(text.find("sRGB"), std::string_view::npos);
}

}  // namespace
}  // namespace scree::vision
