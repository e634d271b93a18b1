#include "terrain/material/map_rgba.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"

#include <numbers>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Row DM-01: what comes back lies within half a step.
TEST(MapRgba, RoundTripIsWithinHalfAStep) {
    for (const int bits : {8, 16})
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const DescriptionMap map = test::random_map(23, 11, seed);
            ConversionReport report;
            const DescriptionMap again = unpack_map(pack_map(map, bits, &report), 9.0);
            const double half = 0.5 / ((1 << bits) - 1) * (1.0 + 1e-3);
            double worst = 0.0;
            for (std::size_t i = 0; i < map.ids.size(); ++i) {
                const double repose = std::abs(again.repose.data()[i] - map.repose.data()[i]);
                EXPECT_LE(repose, half * std::numbers::pi / 2.0);
                worst = std::max(worst, repose);
                EXPECT_LE(std::abs(again.mobility.data()[i] - map.mobility.data()[i]), half);
                EXPECT_LE(std::abs(again.diffusion.data()[i] - map.diffusion.data()[i]), half);
            }
            EXPECT_EQ(again.ids, map.ids);
            EXPECT_EQ(again.cell_size, map.cell_size);
            EXPECT_FALSE(report.exact());
            EXPECT_NEAR(report.repose_deg, worst * 180.0 / std::numbers::pi, 1e-4);
        }
}

TEST(MapRgba, PackingAgainGivesTheSamePicture) {
    for (const int bits : {8, 16})
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const RgbaMap once = pack_map(test::random_map(23, 11, seed, seed % 2 == 0), bits);
            ConversionReport report;
            const RgbaMap again = pack_map(unpack_map(once, 1.0), bits, &report);
            EXPECT_EQ(again.picture, once.picture);
            EXPECT_EQ(again.ids, once.ids);
            EXPECT_LT(report.repose_deg, 1e-4);
        }
}

TEST(MapRgba, PlanesThatSayNothingNewAreDropped) {
    const DescriptionMap map = test::random_map(23, 11, 3, false);
    const DescriptionMap again = unpack_map(pack_map(map, 16), 1.0);
    EXPECT_TRUE(again.repose.empty());
    EXPECT_TRUE(again.mobility.empty());
    EXPECT_TRUE(again.diffusion.empty());
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(again.materials[i].soil.repose_deg, map.materials[i].soil.repose_deg, 7e-4);
}

TEST(MapRgba, CodesAreTheOnesSaid) {
    DescriptionMap map = test::random_map(2, 1, 0, false);
    map.ids(0, 0) = 7;
    map.ids(1, 0) = 0;
    map.materials[2].soil = {.repose_deg = 45.0, .mobility = 2.0, .diffusion = 0.2};
    const RgbaMap eight = pack_map(map, 8);
    EXPECT_EQ(eight.picture.values(0, 0), glm::u16vec4(128, 255, 51, 7));
    EXPECT_EQ(eight.picture.values(1, 0), glm::u16vec4(96, 64, 51, 0));
    EXPECT_EQ(eight.ids.mobility_max, 2.0);
    EXPECT_EQ(eight.ids.diffusion_max, 1.0);
    const RgbaMap wide = pack_map(map, 16);
    EXPECT_EQ(wide.picture.values(0, 0), glm::u16vec4(32768, 65535, 13107, 7 * 257));
    EXPECT_EQ(wide.picture.values(0, 0).w / 65535.0, 7 / 255.0);  // the code t agrees
}

TEST(MapRgba, NearlyVerticalReposeStaysBelowARightAngle) {
    DescriptionMap map = test::random_map(4, 4, 0);
    for (float& value : map.repose)
        value = 1.570796F;
    for (const int bits : {8, 16}) {
        const RgbaMap once = pack_map(map, bits);
        EXPECT_EQ(once.picture.values(0, 0).x, (1 << bits) - 2);
        const DescriptionMap again = unpack_map(once, 1.0);
        EXPECT_FALSE(again.repose.empty());
        EXPECT_EQ(pack_map(again, bits).picture, once.picture);
    }
}

TEST(MapRgba, FilesKeepEveryBit) {
    const test::TempDir dir;
    for (const int bits : {8, 16}) {
        const RgbaMap map = pack_map(test::random_map(23, 11, 5), bits);
        vision::write_rgba_png(dir / "m.png", map.picture);
        write_whole_file(dir / "m.txt", std::string_view(ids_to_text(map.ids, dir.path())));
        const RgbaMap again = read_rgba_map(dir / "m.png", dir / "m.txt");
        EXPECT_EQ(again.picture, map.picture);
        EXPECT_EQ(again.ids, map.ids);
    }
}

TEST(MapRgba, ReportsWhatHasNoPlace) {
    DescriptionMap map = test::random_map(3, 3, 0, false);
    map.ids = Raster<std::uint8_t>(3, 3, std::uint8_t{3});
    map.materials[1].soil = {.repose_deg = 90.0 * 51 / 255, .mobility = 0.2, .diffusion = 0.4};
    map.materials[0].soil.compaction = 0.5;
    map.materials[1].textures.albedo = "a.png";
    map.materials[1].textures.size_m = 2.0;
    ConversionReport report;
    pack_map(map, 8, &report);
    EXPECT_EQ(report.repose_deg, 0.0);
    EXPECT_EQ(report.mobility, 0.0);
    EXPECT_THAT(report.without_cells, ElementsAre(0, 7));
    EXPECT_THAT(report.lost, ElementsAre("material 0: compaction",
                                         "material 3: size of its textures in metres"));
    EXPECT_FALSE(report.exact());
}

TEST(MapRgba, SaysWhatIsWrong) {
    RgbaMap map = pack_map(test::random_map(4, 3, 1), 16);
    const auto refused = [](const RgbaMap& broken, const std::string& words) {
        EXPECT_THAT([&] { unpack_map(broken, 1.0); },
                    ThrowsMessage<InvalidInput>(HasSubstr(words)));
    };
    RgbaMap odd = map;
    odd.picture.values(2, 1).w = 258;
    refused(odd, "cell (2, 1) has an alpha of 258");
    odd.picture.values(2, 1).w = 9 * 257;
    refused(odd, "cell (2, 1) has the id 9, which has no material");
    odd = map;
    odd.picture.values(3, 2).x = 65535;
    refused(odd, "cell (3, 2) of id");
    refused({{}, map.ids}, "0 x 0 cells");
    EXPECT_THROW(pack_map(test::random_map(4, 3, 1), 10), InvalidOption);
}

}  // namespace
}  // namespace scree::terrain
