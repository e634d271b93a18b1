#include "base/error.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

namespace scree::vision {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

// ---- making files

void put(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
}

std::string get(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
void write(const fs::path& path, OIIO::ImageSpec spec, const std::vector<T>& values) {
    const auto output = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(output);
    ASSERT_TRUE(output->open(path.string(), spec)) << output->geterror();
    ASSERT_TRUE(output->write_image(OIIO::BaseTypeFromC<T>::value, values.data()));
    ASSERT_TRUE(output->close());
}

std::vector<std::uint8_t> pattern(int width, int height, int n_channels) {
    std::vector<std::uint8_t> values(static_cast<std::size_t>(width * height * n_channels));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::uint8_t>((i * 7919) % 251);
    return values;
}

std::string big(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
            static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string little(std::uint32_t value, int n) {
    std::string text;
    for (int i = 0; i < n; ++i)
        text += static_cast<char>(std::uint64_t{value} >> (8 * i));
    return text;
}

std::string png_chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return big(static_cast<std::uint32_t>(data.size())) + type + data + big(~crc);
}

// `rows` holds the filter byte and the samples of every row; stored without compression.
std::string png(std::uint32_t width, std::uint32_t height, char bits, char kind,
                const std::string& extra, const std::string& rows) {
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : rows) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto n = static_cast<std::uint32_t>(rows.size());
    const std::string packed =
        "\x78\x01\x01" + little(n, 2) + little(~n, 2) + rows + big((b << 16) | a);
    const std::string header = big(width) + big(height) + bits + kind + std::string(3, '\0');
    return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + extra + png_chunk("IDAT", packed) +
           png_chunk("IEND", "");
}

// An uncompressed little-endian TIFF of 8-bit samples in one strip.
std::string tiff(std::uint32_t width, std::uint32_t height, std::uint32_t photometric,
                 std::uint32_t n_channels, const std::string& samples) {
    const auto entry = [](std::uint32_t tag, std::uint32_t type, std::uint32_t count,
                          std::uint32_t value) {
        return little(tag, 2) + little(type, 2) + little(count, 4) + little(value, 4);
    };
    const std::uint32_t bits_at = 8 + 2 + 10 * 12 + 4;
    return std::string("II*\0", 4) + little(8, 4) + little(10, 2) + entry(256, 4, 1, width) +
           entry(257, 4, 1, height) + entry(258, 3, 4, bits_at) + entry(259, 3, 1, 1) +
           entry(262, 3, 1, photometric) + entry(273, 4, 1, bits_at + 8) +
           entry(277, 3, 1, n_channels) + entry(278, 4, 1, height) +
           entry(279, 4, 1, static_cast<std::uint32_t>(samples.size())) + entry(284, 3, 1, 1) +
           little(0, 4) + little(8, 2) + little(8, 2) + little(8, 2) + little(8, 2) + samples;
}

// 8 x 8 pixels of pure red, as four inks.
constexpr std::uint8_t kCmykJpeg[] = {
    0xFF, 0xD8, 0xFF, 0xEE, 0x00, 0x0E, 0x41, 0x64, 0x6F, 0x62, 0x65, 0x00, 0x64, 0x00, 0x00,
    0x00, 0x00, 0x00, 0xFF, 0xDB, 0x00, 0x43, 0x00, 0x08, 0x06, 0x06, 0x07, 0x06, 0x05, 0x08,
    0x07, 0x07, 0x07, 0x09, 0x09, 0x08, 0x0A, 0x0C, 0x14, 0x0D, 0x0C, 0x0B, 0x0B, 0x0C, 0x19,
    0x12, 0x13, 0x0F, 0x14, 0x1D, 0x1A, 0x1F, 0x1E, 0x1D, 0x1A, 0x1C, 0x1C, 0x20, 0x24, 0x2E,
    0x27, 0x20, 0x22, 0x2C, 0x23, 0x1C, 0x1C, 0x28, 0x37, 0x29, 0x2C, 0x30, 0x31, 0x34, 0x34,
    0x34, 0x1F, 0x27, 0x39, 0x3D, 0x38, 0x32, 0x3C, 0x2E, 0x33, 0x34, 0x32, 0xFF, 0xC0, 0x00,
    0x14, 0x08, 0x00, 0x08, 0x00, 0x08, 0x04, 0x43, 0x11, 0x00, 0x4D, 0x11, 0x00, 0x59, 0x11,
    0x00, 0x4B, 0x11, 0x00, 0xFF, 0xC4, 0x00, 0x15, 0x00, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x07, 0x08, 0xFF, 0xC4, 0x00,
    0x14, 0x10, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0xFF, 0xDA, 0x00, 0x0E, 0x04, 0x43, 0x00, 0x4D, 0x00, 0x59, 0x00,
    0x4B, 0x00, 0x00, 0x3F, 0x00, 0x7F, 0x4F, 0xE9, 0xFC, 0xFE, 0xFF, 0xD9};

// ---- kinds of pictures

TEST(ImageKinds, GreyBecomesThreeEqualChannels) {
    const test::TempDir dir;
    write(dir / "g.png", {3, 2, 1, OIIO::TypeDesc::UINT8},
          std::vector<std::uint8_t>{0, 50, 100, 150, 200, 255});
    const Photo photo = read_photo(dir / "g.png").pixels;
    EXPECT_EQ(photo(1, 0), glm::u8vec3(50));
    EXPECT_EQ(photo(2, 1), glm::u8vec3(255));
}

TEST(ImageKinds, SixteenBitsAreRounded) {
    const test::TempDir dir;
    write(dir / "w.png", {2, 1, 3, OIIO::TypeDesc::UINT16},
          std::vector<std::uint16_t>{0, 257, 65535, 128 * 257, 40 * 257, 3});
    const Photo photo = read_photo(dir / "w.png").pixels;
    EXPECT_EQ(photo(0, 0), glm::u8vec3(0, 1, 255));
    EXPECT_EQ(photo(1, 0), glm::u8vec3(128, 40, 0));
}

TEST(ImageKinds, PaletteIsLookedUp) {
    const test::TempDir dir;
    const std::string colours("\x00\x00\x00\xC8\x64\x32\x0A\x14\x1E", 9);
    put(dir / "p.png", png(3, 1, 8, 3, png_chunk("PLTE", colours), std::string("\0\2\1\0", 4)));
    const Photo photo = read_photo(dir / "p.png").pixels;
    EXPECT_EQ(photo(0, 0), glm::u8vec3(10, 20, 30));
    EXPECT_EQ(photo(1, 0), glm::u8vec3(200, 100, 50));
    EXPECT_THROW(read_labels(dir / "p.png"), InvalidInput);
}

TEST(ImageKinds, AlphaIsDroppedAndColoursAreKept) {
    const test::TempDir dir;
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    write(dir / "a.png", spec, std::vector<std::uint8_t>{200, 100, 50, 0, 10, 20, 30, 128});
    const Photo photo = read_photo(dir / "a.png").pixels;
    EXPECT_EQ(photo(0, 0), glm::u8vec3(200, 100, 50));
    EXPECT_EQ(photo(1, 0), glm::u8vec3(10, 20, 30));
    OIIO::ImageSpec grey(2, 1, 2, OIIO::TypeDesc::UINT8);
    grey["oiio:UnassociatedAlpha"] = 1;
    write(dir / "ga.png", grey, std::vector<std::uint8_t>{200, 0, 10, 128});
    EXPECT_EQ(read_photo(dir / "ga.png").pixels(0, 0), glm::u8vec3(200));
}

TEST(ImageKinds, InksBecomeColours) {
    const test::TempDir dir;
    put(dir / "c.jpg", std::string(std::begin(kCmykJpeg), std::end(kCmykJpeg)));
    put(dir / "c.tif", tiff(2, 1, 5, 4, std::string("\x00\xFF\xFF\x00\x00\x00\x00\x00", 8)));
    const Photo jpeg = read_photo(dir / "c.jpg").pixels;
    EXPECT_GT(jpeg(4, 4).r, 240);
    EXPECT_LT(jpeg(4, 4).g, 15);
    EXPECT_LT(jpeg(4, 4).b, 15);
    const Photo picture = read_photo(dir / "c.tif").pixels;
    EXPECT_EQ(picture(0, 0), glm::u8vec3(255, 0, 0));
    EXPECT_EQ(picture(1, 0), glm::u8vec3(255));
}

TEST(ImageKinds, FirstFrameOfAnAnimation) {
    const test::TempDir dir;
    const std::string name = (dir / "m.gif").string();
    const OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeDesc::UINT8);
    const std::vector<OIIO::ImageSpec> frames(2, spec);
    const std::vector<std::uint8_t> white(48, 255);
    const std::vector<std::uint8_t> black(48, 0);
    const auto output = OIIO::ImageOutput::create(name);
    ASSERT_TRUE(output && output->open(name, 2, frames.data()));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, white.data()));
    ASSERT_TRUE(output->open(name, spec, OIIO::ImageOutput::AppendSubimage));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, black.data()));
    ASSERT_TRUE(output->close());
    EXPECT_EQ(read_photo(dir / "m.gif").pixels, Photo(4, 4, glm::u8vec3(255)));
}

TEST(ImageKinds, FloatIsLinearLight) {
    const test::TempDir dir;
    write(dir / "f.exr", {2, 1, 3, OIIO::TypeDesc::FLOAT},
          std::vector<float>{0.0F, 0.215861F, 1.0F, -1.0F, 7.0F, 0.0F});
    const Photo photo = read_photo(dir / "f.exr").pixels;
    EXPECT_EQ(photo(0, 0), glm::u8vec3(0, 128, 255));
    EXPECT_EQ(photo(1, 0), glm::u8vec3(0, 255, 0));
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        write(dir / "n.exr", {1, 1, 3, OIIO::TypeDesc::FLOAT}, std::vector<float>{bad, 0, 0});
        EXPECT_THAT([&] { read_photo(dir / "n.exr"); },
                    ThrowsMessage<InvalidInput>(HasSubstr("no numbers")));
        EXPECT_THROW(read_heights(dir / "n.exr"), InvalidInput);
    }
}

TEST(ImageKinds, ThinBlankAndSinglePixels) {
    const test::TempDir dir;
    const std::pair<int, int> sizes[] = {{1, 1}, {1, 10000}, {10000, 1}};
    for (const auto& [width, height] : sizes)
        for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{255}}) {
            const Photo photo(width, height, glm::u8vec3(value));
            write_png(dir / "t.png", photo);
            EXPECT_EQ(read_photo(dir / "t.png").pixels, photo);
        }
}

TEST(ImageKinds, ScaleComesFromTheMetadata) {
    const test::TempDir dir;
    OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::UINT8);
    const std::pair<const char*, double> cases[] = {
        {"0.00039", 0.00039}, {"-1", 0.0}, {"nan", 0.0}, {"1e99", 0.0}, {"big", 0.0}};
    for (const auto& [text, scale] : cases) {
        spec["scree:metres_per_pixel"] = text;
        write(dir / "s.png", spec, std::vector<std::uint8_t>{1, 2, 3});
        EXPECT_EQ(read_photo(dir / "s.png").metres_per_pixel, scale) << text;
    }
}

TEST(ImageKinds, FewBitsAreNoLabels) {
    const test::TempDir dir;
    put(dir / "one.png", png(8, 1, 1, 0, "", std::string("\0\x55", 2)));
    EXPECT_THAT([&] { read_labels(dir / "one.png"); },
                ThrowsMessage<InvalidInput>(HasSubstr("1 bits a pixel")));
    EXPECT_EQ(read_photo(dir / "one.png").pixels(1, 0), glm::u8vec3(255));
}

// ---- EXIF orientation, by brute force: what each number says of the stored rows and columns

glm::ivec2 shown_at(int orientation, glm::ivec2 p, int w, int h) {  // of the stored pixel p
    switch (orientation) {
        case 1:
            return p;
        case 2:
            return {w - 1 - p.x, p.y};  // mirrored left to right
        case 3:
            return {w - 1 - p.x, h - 1 - p.y};  // half a turn
        case 4:
            return {p.x, h - 1 - p.y};  // mirrored top to bottom
        case 5:
            return {p.y, p.x};  // rows are columns
        case 6:
            return {h - 1 - p.y, p.x};  // needs a quarter turn clockwise
        case 7:
            return {h - 1 - p.y, w - 1 - p.x};
        default:
            return {p.y, w - 1 - p.x};  // a quarter turn back
    }
}

TEST(ImageOrientation, EveryNumberIsUndone) {
    const test::TempDir dir;
    constexpr int kWidth = 5;
    constexpr int kHeight = 3;
    const auto stored = pattern(kWidth, kHeight, 3);
    for (int orientation = 1; orientation <= 8; ++orientation) {
        OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeDesc::UINT8);
        spec["Orientation"] = orientation;
        write(dir / "o.tif", spec, stored);
        const Photo photo = read_photo(dir / "o.tif").pixels;
        ASSERT_EQ(photo.width(), orientation < 5 ? kWidth : kHeight);
        ASSERT_EQ(photo.height(), orientation < 5 ? kHeight : kWidth);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const auto i = static_cast<std::size_t>(3 * (y * kWidth + x));
                const glm::ivec2 p = shown_at(orientation, {x, y}, kWidth, kHeight);
                EXPECT_EQ(photo(p.x, p.y), glm::u8vec3(stored[i], stored[i + 1], stored[i + 2]))
                    << "orientation " << orientation << " at " << x << ", " << y;
            }
    }
}

TEST(ImageOrientation, JpegIsTurnedToo) {
    const test::TempDir dir;
    OIIO::ImageSpec spec(32, 16, 3, OIIO::TypeDesc::UINT8);
    spec["Orientation"] = 6;
    std::vector<std::uint8_t> left_dark(32 * 16 * 3, 255);
    for (std::size_t i = 0; i < left_dark.size(); ++i)
        if (i / 3 % 32 < 16)
            left_dark[i] = 0;
    write(dir / "o.jpg", spec, left_dark);
    const Photo photo = read_photo(dir / "o.jpg").pixels;
    ASSERT_EQ(photo.width(), 16);
    EXPECT_LT(photo(8, 4).g, 20);
    EXPECT_GT(photo(8, 28).g, 235);
}

// ---- files that must be refused

TEST(ImageRefusal, CutFilesOfEveryFormat) {
    const test::TempDir dir;
    for (const char* ending : {"png", "jpg", "tif", "gif", "bmp", "webp", "exr", "ppm", "tga"}) {
        const fs::path whole = dir / (std::string("whole.") + ending);
        const fs::path cut = dir / (std::string("cut.") + ending);
        write(whole, {60, 45, 3, OIIO::TypeDesc::UINT8}, pattern(60, 45, 3));
        EXPECT_NO_THROW(read_photo(whole)) << ending;
        const std::string bytes = get(whole);
        for (const double share : {0.001, 0.01, 0.05, 0.3, 0.5, 0.8, 0.9}) {
            put(cut, bytes.substr(0, 1 + static_cast<std::size_t>(
                                             share * static_cast<double>(bytes.size()))));
            EXPECT_THAT([&] { read_photo(cut); }, ThrowsMessage<Error>(HasSubstr(cut.string())))
                << ending << " at " << share;
        }
    }
}

TEST(ImageRefusal, HugeSizesInTinyFiles) {
    const test::TempDir dir;
    write(dir / "e.exr", {4, 4, 3, OIIO::TypeDesc::FLOAT}, std::vector<float>(48, 0.5F));
    std::string exr = get(dir / "e.exr");
    for (const char* name : {"dataWindow", "displayWindow"}) {
        const auto at = exr.find(std::string(name) + '\0' + "box2i" + '\0');
        ASSERT_NE(at, std::string::npos);
        const std::string window = little(0, 8) + little(19999, 4) + little(14999, 4);
        exr.replace(at + std::string(name).size() + 1 + 6 + 4, 16, window);
    }
    const std::pair<const char*, std::string> files[] = {
        {"h.png", png(20000, 15000, 8, 2, "", "x")},
        {"h.gif", "GIF89a" + little(65535, 2) + little(65535, 2) + std::string("\0\0\0;", 4)},
        {"h.bmp", "BM" + little(200, 4) + little(0, 4) + little(54, 4) + little(40, 4) +
                      little(20000, 4) + little(static_cast<std::uint32_t>(-15000), 4) +
                      little(1, 2) + little(24, 2) + std::string(100, '\0')},
        {"h.jpg", std::string("\xFF\xD8\xFF\xC0\x00\x11\x08\xFF\xFF\xFF\xFF\x03", 12) +
                      std::string("\x01\x11\x00\x02\x11\x00\x03\x11\x00\xFF\xD9", 11)},
        {"h.webp", "RIFF" + little(30, 4) + "WEBPVP8X" + little(10, 4) + little(0, 4) +
                       little(16383, 3) + little(16383, 3) + std::string(20, '\0')},
        {"h.tif", tiff(20000, 15000, 2, 3, "xyz")},
        {"h.ppm", "P6\n20000 15000\n255\nxyz"},
        {"h.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + little(20000, 2) +
                      little(15000, 2) + std::string("\x18\0", 2) + std::string(40, '\0')},
        {"h.exr", exr}};
    for (const auto& [name, bytes] : files) {
        put(dir / name, bytes);
        EXPECT_THAT([&] { read_photo(dir / name); },
                    ThrowsMessage<InvalidInput>(AllOf(HasSubstr(name), HasSubstr("the limit is"))))
            << name;
    }
}

// Found by fuzzing: OpenEXR took the 2 GB that a text attribute of a 94-byte file claimed.
TEST(ImageRefusal, AttributeLongerThanItsFile) {
    const test::TempDir dir;
    put(dir / "a.exr", std::string("\x76\x2F\x31\x01\2\0\0\0capDate\0string\0", 23) +
                           little(0x7FFFFFF0, 4) + std::string(64, 'x'));
    EXPECT_THAT([&] { read_photo(dir / "a.exr"); }, ThrowsMessage<IoError>(HasSubstr("cut off")));
}

// Found by fuzzing: OpenEXR went on behind a window of 16 bytes, whatever length was written.
TEST(ImageRefusal, AttributeOfAnotherLengthThanItsType) {
    const test::TempDir dir;
    put(dir / "a.exr", std::string("\x76\x2F\x31\x01\2\0\0\0dataWindow\0box2i\0", 25) +
                           little(130, 4) + std::string(200, 'x'));
    EXPECT_THAT([&] { read_photo(dir / "a.exr"); }, ThrowsMessage<IoError>(HasSubstr("damaged")));
}

TEST(ImageRefusal, WhatIsNoPictureFile) {
    const test::TempDir dir;
    put(dir / "empty.png", "");
    put(dir / "text.jpg", "this is no picture, whatever it is called");
    put(dir / "zero.tga", std::string(400, '\0'));
    put(dir / "magic.png", "\x89PNG\r\n\x1A\n");
    put(dir / "magic.jpg", "\xFF\xD8\xFF\xD9");
    ASSERT_EQ(::mkfifo((dir / "pipe.png").c_str(), 0600), 0);
    for (const char* name : {"missing.png", "empty.png", "text.jpg", "zero.tga", "magic.png",
                             "magic.jpg", "pipe.png"}) {
        const auto names_file = ThrowsMessage<Error>(HasSubstr(name));
        EXPECT_THAT([&] { read_photo(dir / name); }, names_file);
        EXPECT_THAT([&] { read_labels(dir / name); }, names_file);
        EXPECT_THAT([&] { read_heights(dir / name); }, names_file);
    }
    EXPECT_THAT([&] { read_photo(dir.path()); }, ThrowsMessage<IoError>(HasSubstr("a folder")));
    EXPECT_THAT([&] { read_photo(dir / "text.jpg"); },
                ThrowsMessage<IoError>(HasSubstr("PNG, JPEG, TIFF")));
}

TEST(ImageRefusal, FullDiskIsAnError) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "/dev/full is not there";
    const test::TempDir dir;
    for (const char* name : {"f.png", "f.exr"})
        fs::create_symlink("/dev/full", dir / name);
    const auto full = ThrowsMessage<IoError>(HasSubstr("No space left"));
    EXPECT_THAT([&] { write_png(dir / "f.png", Photo(9, 9)); }, full);
    EXPECT_THAT([&] { write_labels(dir / "f.png", LabelMap(9, 9)); }, full);
    EXPECT_THAT([&] { write_heights_exr(dir / "f.exr", {FloatRaster(9, 9), 0.1}); }, full);
}

TEST(ImageRefusal, WrongNameDoesNotMatter) {
    const test::TempDir dir;
    const Photo photo(7, 5, glm::u8vec3(9, 8, 7));
    write_png(dir / "a.png", photo);
    fs::rename(dir / "a.png", dir / "a.jpeg");
    EXPECT_EQ(read_photo(dir / "a.jpeg").pixels, photo);
}

}  // namespace
}  // namespace scree::vision
