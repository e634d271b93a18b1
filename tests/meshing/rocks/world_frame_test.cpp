#include "meshing/rocks/world_frame.h"

#include "base/error.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

TEST(WorldFrame, CornersOfThePictureLandOnCornersOfTheRegion) {
    const GroundRegion region{3.0, 1.0, {10.0, 2.0, -5.0}};
    const glm::dmat4 w = world_from_image(900, 600, region);
    const glm::dvec3 first = to_world(w, 900, 600, {0, 0, 0});
    const glm::dvec3 last = to_world(w, 900, 600, {900, 0, 600});
    EXPECT_NEAR(first.x, 8.5, 1e-12);
    EXPECT_NEAR(first.y, 2.0, 1e-12);
    EXPECT_NEAR(first.z, -5.5, 1e-12);
    EXPECT_NEAR(last.x, 11.5, 1e-12);
    EXPECT_NEAR(last.z, -4.5, 1e-12);
}

TEST(WorldFrame, HeightsScaleWithTheDiagonals) {
    const glm::dmat4 w = world_from_image(300, 400, {6.0, 2.5, {}});
    EXPECT_DOUBLE_EQ(to_world(w, 300, 400, {150, 500, 200}).y, 6.5);
}

TEST(WorldFrame, RegionFollowsTheScale) {
    vision::RockSet set;
    set.width = 1000;
    set.height = 500;
    EXPECT_DOUBLE_EQ(region_of(set).width, 1.0);
    set.metres_per_pixel = 0.002;
    EXPECT_DOUBLE_EQ(region_of(set).width, 2.0);
    EXPECT_DOUBLE_EQ(region_of(set).depth, 1.0);
    const glm::dmat4 w = world_from_image(1000, 500, region_of(set));
    EXPECT_DOUBLE_EQ(w[0][0], 0.002);
    EXPECT_DOUBLE_EQ(w[1][1], 0.002);
    EXPECT_DOUBLE_EQ(w[2][2], 0.002);
}

TEST(WorldFrame, RefusesWhatHasNoSize) {
    vision::RockSet set;
    EXPECT_THROW(region_of(set), InvalidInput);
    set.width = set.height = 10;
    set.metres_per_pixel = std::numeric_limits<double>::infinity();
    EXPECT_THROW(region_of(set), InvalidInput);
    EXPECT_THAT(
        [] {
            world_from_image(10, 10, {0.0, 1.0, {}});
        },
        testing::ThrowsMessage<InvalidInput>(
            "the ground region is 0 x 1 m, both sides must be positive"));
    EXPECT_THROW(world_from_image(10, 10, {NAN, 1.0, {}}), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
