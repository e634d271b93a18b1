#include "terrain/view/view_matrices.h"

#include "base/error.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::terrain {
namespace {

glm::vec3 projected(const glm::mat4& clip, const glm::vec3& point) {
    const glm::vec4 at = clip * glm::vec4(point, 1.0F);
    return glm::vec3(at) / at.w;
}

TEST(Camera, HasTheWholeGroundInViewFromEverySide) {
    Heightfield field{FloatRaster(40, 25), 0.2};
    field.heights(3, 4) = 1.5F;
    field.heights(30, 20) = -0.7F;
    for (const double azimuth : {-170.0, -40.0, 0.0, 25.0, 90.0})
        for (const double elevation : {5.0, 30.0, 60.0, 90.0})
            for (const double aspect : {0.7, 1.6}) {
                const TerrainCamera camera = camera_over(field, azimuth, elevation, aspect);
                const ViewBox box{{0.0F, -0.7F, 0.0F}, {8.0F, 1.5F, 5.0F}};
                const glm::mat4 clip = clip_from_world(camera, aspect, box);
                float widest = 0.0F;
                for (const float x : {0.0F, 8.0F})
                    for (const float y : {-0.7F, 1.5F})
                        for (const float z : {0.0F, 5.0F}) {
                            const glm::vec3 at = glm::abs(projected(clip, {x, y, z}));
                            EXPECT_LE(at.z, 1.0F);
                            widest = std::max({widest, at.x, at.y});
                        }
                EXPECT_LT(widest, 0.96F);
                EXPECT_GT(widest, 0.85F);
            }
}

TEST(Camera, OfAWindowLooksAtIt) {
    const Heightfield field{FloatRaster(100, 100), 0.1};
    const TerrainCamera camera = camera_over(field, 0.0, 90.0, 1.0, {60, 20, 20, 20});
    EXPECT_NEAR(camera.target.x, 7.0F, 1e-4F);
    EXPECT_NEAR(camera.target.z, 3.0F, 1e-4F);
}

TEST(CameraErrors, NameWhatIsWrong) {
    TerrainCamera camera;
    camera.eye = camera.target;
    EXPECT_THROW(clip_from_world(camera, 1.0, {}), InvalidInput);
    camera.eye.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(clip_from_world(camera, 1.0, {}), InvalidInput);
    EXPECT_THAT([] { sun_direction({.elevation_deg = -3.0}); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("-3 deg")));
    EXPECT_THROW(bounds_of({TerrainObject{}}, glm::vec3(0.0F)), InvalidInput);
}

TEST(ShadowMap, HoldsTheCastersAndTheGroundBehindThem) {
    const ViewBox casters{{1.0F, 0.2F, 1.0F}, {2.0F, 1.0F, 1.5F}};
    const ViewBox ground{{0.0F, -0.5F, 0.0F}, {4.0F, 0.3F, 4.0F}};
    for (const double elevation : {8.0, 38.0, 90.0}) {
        const glm::vec3 sun = sun_direction({30.0, elevation});
        const glm::mat4 map = shadow_from_world(sun, casters, ground);
        for (const glm::vec3& point : {casters.low, casters.high}) {
            const glm::vec3 at = projected(map, point);
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(at[i], 0.0F);
                EXPECT_LE(at[i], 1.0F);
            }
            // Farther from the sun is deeper.
            EXPECT_GT(projected(map, point - 0.1F * sun).z, at.z);
        }
        EXPECT_LE(projected(map, ground.low).z, 1.0F);
    }
}

TEST(Undersides, MapBoundsToTheUnitBox) {
    const ViewBox box{{1.0F, 0.5F, -2.0F}, {3.0F, 0.9F, 4.0F}};
    const glm::mat4 map = under_from_world(box);
    const glm::vec3 low = projected(map, box.low);
    const glm::vec3 high = projected(map, box.high);
    EXPECT_NEAR(glm::length(low), 0.0F, 1e-6F);
    EXPECT_NEAR(glm::distance(high, glm::vec3(1.0F)), 0.0F, 1e-5F);
}

}  // namespace
}  // namespace scree::terrain
