#include "tests/support/golden.h"

#include "meshing/render/raster_view.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/world_frame.h"
#include "testdata/synthetic_photo.h"
#include "tests/support/temp_dir.h"
#include "vision/data/grain_size.h"
#include "vision/data/overlay.h"
#include "vision/data/size_plot.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cstdlib>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree {
namespace {

// The pictures that people judge a run by, made of a photograph's true rocks.
class Golden : public testing::Test {
protected:
    Golden() {
        const auto made = test::make_synthetic_photo(
            {.width = 240, .height = 160, .n_rocks = 40, .greatest_diameter = 60});
        photo_ = made.photo;
        set_ = {.image = "made.png",
                .width = 240,
                .height = 160,
                .metres_per_pixel = 0.001,
                .method = "truth",
                .rocks = {}};
        for (const vision::Outline& outline : made.outlines) {
            const float depth = *std::min_element(outline.radii.begin(), outline.radii.end());
            set_.rocks.push_back({outline, depth, 0.0F});
            const auto place = static_cast<float>(set_.rocks.size() % 5);
            set_.rocks.back().outline.confidence = 0.25F * place;  // every colour of the ramp
        }
    }

    testing::AssertionResult matches(const Photo& picture, const std::string& name,
                                     const test::Tolerance& tolerance = {}) const {
        vision::write_png(dir_ / name, picture);
        return test::matches_golden(dir_ / name, name, tolerance);
    }

    test::TempDir dir_;
    Photo photo_;
    vision::RockSet set_;
};

TEST_F(Golden, Overlay) {
    EXPECT_TRUE(matches(vision::draw_overlay(photo_, set_), "overlay.png"));
}

TEST_F(Golden, Sizes) {
    const auto curve = vision::grain_size_curve(set_);
    EXPECT_TRUE(matches(vision::draw_size_plot(curve, {.width = 480, .height = 320}), "sizes.png"));
}

TEST_F(Golden, Preview) {
    const auto meshes = meshing::build_rock_meshes(set_);
    const meshing::GroundRegion region = meshing::region_of(set_);
    meshing::ViewScene scene;
    scene.photo = &photo_;
    scene.ground_size = {region.width, region.depth};
    for (const meshing::RockMesh& rock : meshes)
        scene.objects.push_back({&rock.mesh, glm::translate(glm::mat4(1.0F), rock.position)});
    const meshing::ViewPictures view = meshing::draw_view(scene, {.width = 240});
    // Edges of shadows jump by a sample where a last bit of a vertex differs.
    EXPECT_TRUE(matches(meshing::side_by_side(view.textured, view.clay), "preview.png",
                        {.fail = 0.02, .fail_percent = 0.2, .hard_fail = 0.4}));
}

TEST(GoldenSupport, SaysHowFarAPictureIsOff) {
    if (std::getenv("SCREE_UPDATE_GOLDEN") != nullptr)
        GTEST_SKIP() << "the kept pictures are being replaced";
    const test::TempDir dir;
    vision::write_png(dir / "grey.png", Photo(480, 320, glm::u8vec3(128)));
    const auto result = test::matches_golden(dir / "grey.png", "sizes.png");
    EXPECT_FALSE(result);
    EXPECT_THAT(result.message(), testing::HasSubstr("% of the pixels differ"));
    EXPECT_FALSE(test::matches_golden(dir / "grey.png", "overlay.png"));
    EXPECT_FALSE(test::matches_golden(dir / "grey.png", "no_such.png"));
}

}  // namespace
}  // namespace scree
