#include "terrain/scene/ground_builder.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "terrain/scene/ground_noise.h"
#include "terrain/scene/scene_file.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;

Scene scene_of(const std::string& ground, const std::string& more = "") {
    return scene_from_json(
        R"({"format": "scree-scene", "version": 1, "ground": {)" + ground + "}" + more + "}",
        "s.json", "");
}

const std::string kPlain = R"("width": 40, "height": 30, "cell_size_m": 0.1)";

double steepest(const Heightfield& field) {
    double most = 0.0;
    for (int y = 0; y < field.heights.height(); ++y)
        for (int x = 0; x + 1 < field.heights.width(); ++x)
            most = std::max(
                most, std::abs(static_cast<double>(field.heights(x + 1, y)) - field.heights(x, y)) /
                          field.cell_size);
    return most;
}

TEST(GroundBuilder, APlainGroundIsFlat) {
    const Heightfield field = build_heights(scene_of(kPlain));
    EXPECT_EQ(field.heights, FloatRaster(40, 30));
    EXPECT_EQ(field.cell_size, 0.1);
}

TEST(GroundBuilder, APileIsACone) {
    const Heightfield field = build_heights(scene_of(
        kPlain +
        R"(, "shapes": [{"kind": "pile", "centre_m": [2.05, 1.55], "height_m": 1, "slope_deg": 45}])"));
    EXPECT_NEAR(field.heights(20, 15), 1.0F, 1e-6F);
    EXPECT_NEAR(field.heights(25, 15), 0.5F, 1e-6F);
    EXPECT_EQ(field.heights(0, 0), 0.0F);
    EXPECT_NEAR(steepest(field), 1.0, 1e-5);
}

TEST(GroundBuilder, ADuneIsSteepToTheLee) {
    const Heightfield field = build_heights(scene_of(
        R"("width": 200, "height": 200, "cell_size_m": 0.02,
           "shapes": [{"kind": "dune", "centre_m": [2, 2], "height_m": 0.4, "length_m": 3,
                       "slope_deg": 50}])"));
    EXPECT_NEAR(*std::max_element(field.heights.begin(), field.heights.end()), 0.4F, 0.02F);
    double windward = 0.0;
    double lee = 0.0;
    for (int x = 0; x < 199; ++x) {
        const double rise = (field.heights(x + 1, 100) - field.heights(x, 100)) / 0.02;
        windward = std::max(windward, rise);
        lee = std::max(lee, -rise);
    }
    EXPECT_LT(std::atan(windward), 0.5);
    EXPECT_NEAR(std::atan(lee) * 180 / M_PI, 50, 1);
}

TEST(GroundBuilder, ShapesAddUp) {
    const std::string ramp = R"({"kind": "ramp", "slope_deg": 10})";
    const std::string mound = R"({"kind": "mound", "centre_m": [1, 1], "height_m": 2})";
    const std::string others =
        R"({"kind": "hills", "seed": 4}, {"kind": "ripples", "length_m": 0.5})";
    const auto built = [](const std::string& shapes) {
        return build_heights(scene_of(kPlain + ", \"shapes\": [" + shapes + "]")).heights;
    };
    const FloatRaster all = built(ramp + "," + mound + "," + others);
    const FloatRaster some = built(ramp + "," + mound);
    const FloatRaster rest = built(others);
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_NEAR(all.data()[i], some.data()[i] + rest.data()[i], 1e-5);
    EXPECT_NEAR(built(ramp)(30, 3) - built(ramp)(20, 9), std::tan(10 * M_PI / 180), 1e-5);
}

TEST(GroundBuilder, NoiseIsSmoothBoundedAndKeyed) {
    double most = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double x = 0.037 * i;
        const double value = fractal_noise(x, -0.5 * x, 5, 9);
        most = std::max(most, std::abs(value));
        EXPECT_NEAR(fractal_noise(x + 1e-6, -0.5 * x, 5, 9), value, 1e-3);
    }
    EXPECT_LT(most, 1.0);
    EXPECT_GT(most, 0.2);
    EXPECT_NE(fractal_noise(0.4, 0.3, 3, 1), fractal_noise(0.4, 0.3, 3, 2));
    EXPECT_EQ(plane_noise(3, -5, 1), 0.0);
}

TEST(GroundBuilder, ReadsAPictureOfHeights) {
    const test::TempDir dir;
    FloatRaster heights(5, 4, 1.5F);
    heights(3, 2) = 4.0F;
    vision::write_heights_exr(dir / "h.exr", {heights, 0.5});
    const Heightfield field = build_heights(scene_of(R"("cell_size_m": 0.5, "height_scale": 2,
        "heights": ")" + (dir / "h.exr").string() + "\""));
    EXPECT_EQ(field.heights.width(), 5);
    EXPECT_EQ(field.heights(3, 2), 8.0F);
    EXPECT_EQ(field.heights(0, 0), 3.0F);
}

TEST(GroundBuilder, PaintsRegionsInTheirOrder) {
    const Scene scene = scene_of(kPlain, R"(, "materials": [{"id": 2, "name": "a"},
        {"id": 5, "name": "b"}, {"id": 9, "name": "c"}],
        "regions": [{"material": "b", "rect_m": [1, 0, 3, 3]},
                    {"material": "c", "disc_m": [2, 1.5, 0.4]},
                    {"material": "a", "polygon_m": [[0, 0], [4, 0], [4, 0.5], [0, 0.5]]}])");
    const DescriptionMap map = build_map(scene, build_heights(scene));
    EXPECT_EQ(map.ids(3, 20), 2);
    EXPECT_EQ(map.ids(12, 20), 5);
    EXPECT_EQ(map.ids(20, 15), 9);
    EXPECT_EQ(map.ids(20, 2), 2);
    EXPECT_EQ(build_map(scene_of(kPlain), build_heights(scene_of(kPlain))).ids.size(), 1U);
}

TEST(GroundBuilderErrors, NameTheSceneAndThePath) {
    const test::TempDir dir;
    vision::write_png(dir / "p.png", Photo(4, 4));
    write_whole_file(dir / "h.exr", std::string_view("no picture"));
    const Scene scene =
        scene_of(R"("cell_size_m": 0.5, "heights": ")" + (dir / "h.exr").string() + "\"");
    EXPECT_THROW(build_heights(scene), IoError);
    // A header that declares 60,000 x 60,000 pixels, in a few bytes.
    std::string header = "P5\n60000 60000\n255\n";
    write_whole_file(dir / "huge.pgm", std::string_view(header));
    const Scene huge =
        scene_of(R"("cell_size_m": 0.5, "heights": ")" + (dir / "huge.pgm").string() + "\"");
    EXPECT_THAT([&] { build_heights(huge); },
                testing::ThrowsMessage<InvalidInput>(testing::AllOf(
                    HasSubstr("s.json: ground.heights"), HasSubstr("60000 x 60000"))));
}

}  // namespace
}  // namespace scree::terrain
