#include "terrain/material/map_files.h"

#include "base/error.h"
#include "terrain/material/materials_json.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"
#include "vision/image_io.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(MapFiles, KeepEveryCellAndWriteTheSameBytesAgain) {
    const test::TempDir dir;
    for (const bool planes : {true, false}) {
        const DescriptionMap map = test::random_map(33, 17, 4, planes);
        write_description_map(map, dir / "a");
        const DescriptionMap again = read_description_map(dir / "a" / "materials.json");
        EXPECT_TRUE(test::same_map(map, again));
        EXPECT_TRUE(test::same_map(map, read_description_map(dir / "a")));
        write_description_map(again, dir / "b");
        for (const char* name : {"materials.json", "ids.png"})
            EXPECT_EQ(read_whole_file(dir / "a" / name, 1 << 20),
                      read_whole_file(dir / "b" / name, 1 << 20));
        if (planes) {
            EXPECT_EQ(read_whole_file(dir / "a" / "params.exr", 1 << 20),
                      read_whole_file(dir / "b" / "params.exr", 1 << 20));
        } else {
            EXPECT_THAT(read_whole_file(dir / "b" / "materials.json", 1 << 20),
                        testing::Not(HasSubstr("params.exr")));
        }
    }
}

TEST(MapFiles, KeepOnePlaneOfThree) {
    const test::TempDir dir;
    DescriptionMap map = test::random_map(6, 5, 2);
    map.repose = {};
    map.diffusion = {};
    write_description_map(map, dir.path());
    EXPECT_TRUE(test::same_map(map, read_description_map(dir.path())));
}

TEST(MapFiles, SayWhatIsWrong) {
    const test::TempDir dir;
    const auto refused = [&](const std::string& words) {
        EXPECT_THAT([&] { read_description_map(dir.path()); },
                    ThrowsMessage<InvalidInput>(HasSubstr(words)));
    };
    write_description_map(test::random_map(6, 5, 2), dir.path());
    vision::write_png(dir / "ids.png", Raster<std::uint8_t>(6, 5, std::uint8_t{99}));
    refused("materials.json: cell (0, 0) has the id 99");
    vision::write_png(dir / "ids.png", Raster<std::uint8_t>(7, 5));
    refused("repose has 6 x 5 cells, the ids have 7 x 5");
    vision::write_png(dir / "ids.png", Photo(6, 5));
    refused("no label map");
    vision::write_labels(dir / "ids.png", LabelMap(6, 5, std::uint16_t{256}));
    refused("ids.png holds the id 256");
    vision::write_png(dir / "ids.png", Raster<std::uint8_t>(6, 5));
    const vision::NamedPlane other{"speed", FloatRaster(6, 5)};
    vision::write_planes_exr(dir / "params.exr", {&other, 1});
    refused("params.exr has the channel speed");
    const std::string table = materials_to_json({1.0, {}, {}, test::three_materials()}, dir.path());
    write_whole_file(dir / "materials.json", std::string_view(table));
    refused("table of materials alone");
    fs::remove(dir / "materials.json");
    EXPECT_THROW(read_description_map(dir.path()), IoError);
}

TEST(MapFiles, AreNotWrittenIfTheMapIsWrong) {
    const test::TempDir dir;
    DescriptionMap map = test::random_map(6, 5, 2);
    map.ids(2, 2) = 1;
    EXPECT_THROW(write_description_map(map, dir / "new"), InvalidInput);
    EXPECT_FALSE(fs::exists(dir / "new"));
}

}  // namespace
}  // namespace scree::terrain
