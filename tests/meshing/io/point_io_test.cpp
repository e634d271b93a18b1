#include "meshing/io/point_io.h"

#include "base/error.h"
#include "tests/support/las_file.h"

#include <cstring>

#include <gmock/gmock.h>

namespace scree {
namespace {

using meshing::decode_points;
using meshing::PointCloud;
using meshing::PointFormat;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

PointCloud decode(std::string_view bytes, PointFormat format,
                  const meshing::MeshLimits& limits = {}) {
    return decode_points({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                         format, "file", limits);
}

PointCloud decode_las(std::string_view bytes) {
    return decode(bytes, PointFormat::Las);
}

// Far from the origin, as surveys are: floats would round these places to half a metre.
const std::vector<glm::dvec3> kPlaces = {{612345.125, 5512345.25, 101.5},
                                         {612346.375, 5512344.5, 99.875}};

template <class Value>
std::string with(std::string bytes, std::size_t at, Value value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
}

TEST(PointIo, ReadsEveryFormatOfLas) {
    for (int format = 0; format <= 10; ++format) {
        const auto cloud = decode_las(
            test::las_file(kPlaces, {2, 5}, {.format = format, .offset = {600000, 5500000, 0}}));
        ASSERT_EQ(cloud.points.size(), 2U) << format;
        for (std::size_t i = 0; i < 2; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(cloud.points[i][k], kPlaces[i][k], 1e-6) << format;
        EXPECT_THAT(cloud.classes, ElementsAre(2, 5)) << format;
    }
}

TEST(PointIo, LeavesWithheldPointsOut) {
    const std::string old = test::las_file(kPlaces, {2, 2}, {.scale = 0.01});
    EXPECT_EQ(decode_las(with(old, 227 + 15, std::uint8_t{0x82})).points.size(), 1U);
    const std::string modern = test::las_file(kPlaces, {2, 2}, {.format = 6, .scale = 0.01});
    EXPECT_EQ(decode_las(with(modern, 375 + 15, std::uint8_t{0x04})).points.size(), 1U);
}

TEST(PointIo, ReadsPlyInDouble) {
    const auto cloud = decode(
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
        "property double z\nend_header\n612345.125 5512345.25 101.5\n612346.375 5512344.5 99.875\n",
        PointFormat::Ply);
    EXPECT_EQ(cloud.points, kPlaces);
    EXPECT_TRUE(cloud.classes.empty());
}

TEST(PointIo, RefusesDamagedLas) {
    const std::string good = test::las_file(kPlaces, {2, 2}, {.scale = 0.01});
    const auto says = [&](const std::string& bytes, const char* words) {
        EXPECT_THAT([&] { decode_las(bytes); }, ThrowsMessage<InvalidInput>(HasSubstr(words)));
    };
    says("", "cannot read file: it does not begin with the header of a LAS file");
    says(good.substr(0, 226), "does not begin");
    says("X" + good.substr(1), "does not begin");
    says(with(good, 25, std::uint8_t{9}), "it is LAS 1.9, versions 1.0 to 1.4 are read");
    says(with(good, 94, std::uint16_t{100}), "its header has 100 bytes");
    says(with(good, 96, std::uint32_t{4'000'000'000U}), "its points begin at byte 4000000000");
    says(with(good, 104, std::uint8_t{129}), "compressed (LAZ)");
    says(with(good, 104, std::uint8_t{11}), "format 11, 0 to 10 are read");
    says(with(good, 105, std::uint16_t{19}), "a point has 19 bytes, format 0 needs 20");
    says(with(good, 107, std::uint32_t{2'000'000'000U}),
         "declares 2000000000 points, more than its bytes can hold");
    says(with(good, 107, std::uint32_t{0}), "it holds no point");
    says(with(good, 131, std::nan("")), "it scales its places by nan");
    says(with(good, 131, 0.0), "it scales its places by 0");
    says(with(good, 155, 1e300), "point 0 is no place that floats can hold");
}

TEST(PointIo, TakesHugeCountsOfVersion14AtNoWord) {
    const std::string good = test::las_file(kPlaces, {2, 2}, {.format = 6, .scale = 0.01});
    EXPECT_THAT([&] { decode_las(with(good, 247, ~std::uint64_t{0})); },
                ThrowsMessage<InvalidInput>(HasSubstr("more than its bytes can hold")));
    EXPECT_THROW(decode_las(with(good, 94, std::uint16_t{227})), InvalidInput);
}

TEST(PointIo, KeepsItsLimits) {
    const std::string good = test::las_file(kPlaces, {2, 2}, {.scale = 0.01});
    EXPECT_THAT([&] { decode(good, PointFormat::Las, {.max_vertices = 1}); },
                ThrowsMessage<InvalidInput>(HasSubstr("at most 1 are read")));
    EXPECT_THAT([&] { decode(good, PointFormat::Las, {.max_bytes = 100}); },
                ThrowsMessage<InvalidInput>(HasSubstr("at most 100 are read")));
}

TEST(PointIo, TellsTheFormatByTheEnding) {
    EXPECT_EQ(meshing::point_format_of("a/B.LAS"), PointFormat::Las);
    EXPECT_EQ(meshing::point_format_of("b.ply"), PointFormat::Ply);
    EXPECT_THAT([] { meshing::point_format_of("b.laz"); },
                ThrowsMessage<IoError>(HasSubstr("write the .laz file as .las first")));
    EXPECT_THROW(meshing::point_format_of("b.xyz"), IoError);
}

}  // namespace
}  // namespace scree
