#include "base/whole_file.h"
#include "terrain/material/map_files.h"
#include "testdata/ground_mosaic.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

using nlohmann::json;
using test::ProgramRun;
using testing::HasSubstr;

TEST(Classify, WritesRegionsAMapAndTheWeights) {
    const test::TempDir dir;
    const auto mosaic = test::make_ground_mosaic(160, 120, 500'040);
    vision::write_png(dir / "ground.png", mosaic.photo);
    const ProgramRun run = test::scree(
        {"classify", dir / "ground.png", "-o", dir / "out", "--width-m", "1.6", "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output);
    double shares = 0.0;
    for (const json& one : report["classes"])
        shares += one["share"].get<double>();
    EXPECT_NEAR(shares, 1.0, 1e-9);
    EXPECT_NEAR(report["metres_per_pixel"].get<double>(), 0.01, 1e-12);

    const auto regions = terrain::read_ids(std::filesystem::path(dir / "out") / "regions.png");
    EXPECT_EQ(regions.width(), 160);
    EXPECT_EQ(
        vision::read_photo(std::filesystem::path(dir / "out") / "overlay.png").pixels.height(),
        120);
    const auto map = terrain::read_description_map(dir / "out");
    EXPECT_EQ(map.ids.width(), 20);
    EXPECT_NEAR(map.cell_size, 0.08, 1e-12);
    const json file =
        json::parse(read_whole_file(std::filesystem::path(dir / "out") / "classes.json", 1 << 20));
    EXPECT_EQ(file["classifier"]["features"].size(), 22U);
}

TEST(Classify, AWallCannotBeSand) {
    const test::TempDir dir;
    vision::write_png(dir / "ground.png", test::make_ground_mosaic(96, 96, 500'041).photo);
    vision::HeightImage wall{FloatRaster(96, 96), 0.001};
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            wall.metres(x, y) =
                0.02F * static_cast<float>(x);  // 87 degrees at a millimetre a pixel
    vision::write_heights_exr(dir / "wall.exr", wall);
    const ProgramRun run =
        test::scree({"classify", dir / "ground.png", "-o", dir / "out", "--heights",
                     dir / "wall.exr", "--slope-weight", "3", "--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_GT(json::parse(run.output)["classes"][3]["share"], 0.95);
}

TEST(Classify, SaysWhatIsWrong) {
    const test::TempDir dir;
    const ProgramRun missing = test::scree({"classify", dir / "none.png", "-o", dir / "out"});
    EXPECT_EQ(missing.status, 1);
    EXPECT_THAT(missing.errors, HasSubstr("none.png"));
    vision::write_png(dir / "ground.png", Photo(40, 30, glm::u8vec3(120)));
    vision::write_heights_exr(dir / "small.exr", {FloatRaster(9, 9), 0.001});
    const ProgramRun size = test::scree(
        {"classify", dir / "ground.png", "-o", dir / "out", "--heights", dir / "small.exr"});
    EXPECT_EQ(size.status, 1);
    EXPECT_THAT(size.errors, HasSubstr("9 x 9"));
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(dir / "out") / "regions.png"));
}

}  // namespace
}  // namespace scree
