#include "terrain/gpu/gl_context.h"
#include "terrain/material/map_files.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/view/sample_ground.h"
#include "vision/image_io.h"

#include <cstdlib>

#include <gmock/gmock.h>

namespace scree {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A ground of three materials with pictures, in files.
class Render : public testing::Test {
protected:
    void SetUp() override {
        const auto attempt = terrain::GlContext::try_make({.software = true});
        if (!attempt.context)
            GTEST_SKIP() << attempt.reason;
        const terrain::Heightfield ground = terrain::test::rolling_ground(64);
        vision::write_heights_exr(at("base.exr"), {ground.heights, ground.cell_size});
        vision::write_heights_exr(at("ddh.exr"), {terrain::test::groove(ground), ground.cell_size});
        terrain::DescriptionMap map = terrain::test::three_strips(4.0, 32);
        const auto looks = terrain::test::strip_looks(64);
        for (std::size_t i = 0; i < looks.size(); ++i) {
            terrain::MaterialTextures& textures = map.materials[i].textures;
            textures.albedo = at(map.materials[i].name + ".png");
            textures.displacement = at(map.materials[i].name + ".exr");
            textures.size_m = looks[i].size_m;
            vision::write_png(textures.albedo, looks[i].albedo);
            vision::write_heights_exr(textures.displacement,
                                      {looks[i].displacement, looks[i].size_m / 64});
        }
        terrain::write_description_map(map, folder_.path());
    }

    fs::path at(const std::string& name) const { return folder_ / name; }
    test::ProgramRun render(std::vector<std::string> more) const {
        std::vector<std::string> words{"render",      at("base.exr"), "-o",
                                       at("out.png"), "--software",   "--width",
                                       "120",         "--height",     "80"};
        words.insert(words.end(), more.begin(), more.end());
        return test::scree(words);
    }

    test::TempDir folder_;
};

TEST_F(Render, RocksStandOnGravelNearTheEye) {
    EXPECT_EQ(render({"--near", "1"}).status, 2);
    EXPECT_EQ(render({"--rocks", at("r.glb")}).status, 2);
    ASSERT_EQ(test::scree({"procedural", "-o", at("r.glb"), "--seed", "3", "--quiet"}).status, 0);
    const auto picture = [&](const char* near_m) {
        const auto run = render({"--rocks", at("r.glb"), "--near", near_m});
        EXPECT_EQ(run.status, 0) << run.errors;
        return vision::read_photo(at("out.png")).pixels;
    };
    ASSERT_EQ(render({}).status, 0);
    const Photo none = vision::read_photo(at("out.png")).pixels;
    EXPECT_EQ(picture("0.01"), none);
    EXPECT_NE(picture("1000"), none);
}

TEST_F(Render, DrawsFromFiles) {
    std::vector<Photo> pictures;
    for (const char* view : {"textured", "wire"}) {
        const auto run =
            render({"--view", view, "--map", at("materials.json"), "--ddh", at("ddh.exr")});
        ASSERT_EQ(run.status, 0) << run.errors;
        EXPECT_THAT(run.output, HasSubstr("120 x 80 px, drawn by"));
        pictures.push_back(vision::read_photo(at("out.png")).pixels);
        EXPECT_EQ(pictures.back().width(), 120);
        EXPECT_EQ(pictures.back().height(), 80);
    }
    EXPECT_NE(pictures[0], pictures[1]);
    const auto plain = render({"--view", "height"});  // heights alone are enough
    ASSERT_EQ(plain.status, 0) << plain.errors;
    EXPECT_NE(vision::read_photo(at("out.png")).pixels, pictures[1]);
}

TEST_F(Render, ErrorsNameTheFileAndTheRemedy) {
    vision::write_png(at("grey.png"), Raster<std::uint8_t>(20, 20, 128));
    auto run = test::scree({"render", at("grey.png"), "-o", at("out2.png")});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("does not say its heights in metres; give that of white with "
                                      "--height-m"));
    run = test::scree({"render", at("grey.png"), "-o", at("out2.png"), "--height-m", "2"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("does not say its scale; give it with --width-m"));
    vision::write_heights_exr(at("small.exr"), {FloatRaster(8, 8), 0.1});
    run = render({"--ddh", at("small.exr")});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("has 8 x 8 cells"));
    EXPECT_EQ(render({"--elevation", "91"}).status, 2);
    EXPECT_FALSE(fs::exists(at("out2.png")));
}

TEST_F(Render, WithoutADeviceSaysWhatToInstall) {
    // A folder without drivers, in place of the system's.
    ::setenv("__EGL_VENDOR_LIBRARY_DIRS", at("none").c_str(), 1);
    const auto run = test::scree({"render", at("base.exr"), "-o", at("out3.png")});
    ::unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.errors, HasSubstr("libegl-mesa0"));
    EXPECT_FALSE(fs::exists(at("out3.png")));
}

}  // namespace
}  // namespace scree
