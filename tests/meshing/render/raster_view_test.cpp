#include "meshing/render/raster_view.h"

#include "base/error.h"
#include "base/parallel.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

TriMesh sphere(float radius) {
    constexpr std::uint32_t kRings = 16;
    constexpr std::uint32_t kSegments = 32;
    TriMesh mesh;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring)
        for (std::uint32_t s = 0; s <= kSegments; ++s) {
            const double v = std::numbers::pi * (static_cast<double>(ring) / kRings - 0.5);
            const double u = 2.0 * std::numbers::pi * s / kSegments;
            const glm::vec3 n(std::cos(u) * std::cos(v), std::sin(v), std::sin(u) * std::cos(v));
            mesh.positions.push_back(radius * n);
            mesh.normals.push_back(n);
            mesh.texcoords.emplace_back(0.5F + 0.4F * n.x, 0.5F + 0.4F * n.z);
        }
    for (std::uint32_t c = 0; c < kRings * (kSegments + 1); ++c) {
        mesh.triangles.emplace_back(c, c + kSegments, c + kSegments + 1);
        mesh.triangles.emplace_back(c + kSegments + 1, c + 1, c);
    }
    return mesh;
}

int brightness(const glm::u8vec3& colour) {
    return colour.x + colour.y + colour.z;
}

TEST(RasterView, ShowsLightShadeAndShadow) {
    const TriMesh ball = sphere(0.2F);
    ViewScene scene{.objects = {{&ball}}, .ground_size = {1.0F, 1.0F}};
    const ViewOptions from_above{
        .width = 200, .azimuth = 0, .elevation = 89, .light_azimuth = 90, .light_elevation = 30};
    const ViewPictures view = draw_view(scene, from_above);
    EXPECT_TRUE(view.textured.empty());
    ASSERT_EQ(view.clay.width(), 200);
    EXPECT_NEAR(view.clay.height(), 200, 8);
    const int middle = view.clay.height() / 2;
    const int lit = brightness(view.clay(130, middle));
    const int dark = brightness(view.clay(68, middle));
    const int shadow = brightness(view.clay(40, middle));
    const int ground = brightness(view.clay(180, middle));
    EXPECT_GT(lit, dark + 150);
    EXPECT_GT(ground, shadow + 150);
}

TEST(RasterView, LaysThePhotographOverGroundAndObjects) {
    const TriMesh ball = sphere(0.2F);
    const Photo red(64, 64, {220, 20, 20});
    const ViewScene scene{.objects = {{&ball}}, .photo = &red, .ground_size = {1.0F, 1.0F}};
    const ViewPictures view = draw_view(scene, {.width = 120});
    ASSERT_EQ(view.textured.width(), 120);
    const glm::u8vec3 ball_colour = view.textured(60, view.textured.height() / 2);
    const glm::u8vec3 ground_colour = view.textured(60, view.textured.height() * 5 / 6);
    EXPECT_GT(ball_colour.x, 4 * ball_colour.y);
    EXPECT_GT(ground_colour.x, 3 * ground_colour.y);
    const glm::u8vec3 clay_colour = view.clay(60, view.clay.height() / 2);
    EXPECT_NEAR(clay_colour.x, clay_colour.y, 16);
}

TEST(RasterView, DrawsInstancesWhereTheirMatricesPutThem) {
    const TriMesh ball = sphere(0.1F);
    ViewScene scene;
    for (const float x : {-0.5F, 0.5F})
        scene.objects.push_back({&ball, glm::translate(glm::mat4(1.0F), glm::vec3(x, 0, 0))});
    const ViewPictures view = draw_view(scene, {.width = 240, .azimuth = 0, .elevation = 89});
    const int middle = view.clay.height() / 2;
    const glm::u8vec3 backdrop = view.clay(120, middle);
    EXPECT_NE(view.clay(24, middle), backdrop);
    EXPECT_NE(view.clay(215, middle), backdrop);
}

TEST(RasterView, GivesTheSamePictureForAnyThreadCount) {
    const TriMesh ball = sphere(0.2F);
    const Photo photo(40, 30, {90, 120, 60});
    const ViewScene scene{.objects = {{&ball}}, .photo = &photo, .ground_size = {1.0F, 0.7F}};
    const ViewPictures parallel = draw_view(scene, {.width = 160});
    const ThreadLimit one(1);
    const ViewPictures serial = draw_view(scene, {.width = 160});
    EXPECT_EQ(parallel.textured, serial.textured);
    EXPECT_EQ(parallel.clay, serial.clay);
}

TEST(RasterView, FramesLongAndFlatScenes) {
    const Photo photo(3, 3, {90, 120, 60});
    for (const glm::vec2 size : {glm::vec2(1, 1e-4F),
                                 {1e-4F, 1},
                                 {1e-6F, 1e-6F},
                                 {10, 0.001F},
                                 {0.001F, 10},
                                 {1e6F, 1e-3F}})
        for (const int width : {80, 600}) {
            const ViewPictures view =
                draw_view({.objects = {}, .photo = &photo, .ground_size = size}, {.width = width});
            EXPECT_GE(view.clay.height(), 8);
            EXPECT_LE(view.clay.height(), width * 3 / 2 + 1);
        }
}

TEST(RasterView, PutsPicturesBesideEachOther) {
    const Photo left(3, 2, {1, 2, 3});
    const Photo right(4, 2, {4, 5, 6});
    const Photo both = side_by_side(left, right, 5);
    EXPECT_EQ(both.width(), 12);
    EXPECT_EQ(both(2, 1), glm::u8vec3(1, 2, 3));
    EXPECT_EQ(both(3, 1), glm::u8vec3(255));
    EXPECT_EQ(both(8, 0), glm::u8vec3(4, 5, 6));
    EXPECT_THROW(side_by_side(left, Photo(4, 3)), InvalidInput);
}

TEST(RasterViewErrors, AreSentences) {
    EXPECT_THAT([] { draw_view({}); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("nothing to draw")));
    EXPECT_THROW(draw_view({.objects = {ViewObject{}}}), InvalidInput);
    EXPECT_THAT(
        [] {
            draw_view({.objects = {}, .ground_size = {1, 1}}, {.elevation = 0});
        },
        testing::ThrowsMessage<InvalidOption>("elevation is 0, must be in [10, 89] deg"));
    TriMesh broken = sphere(1);
    broken.triangles.front().x = 1u << 30;
    EXPECT_THROW(draw_view({.objects = {{&broken}}}), InvalidInput);
    TriMesh whole = sphere(1);
    whole.positions.front().x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(draw_view({.objects = {{&whole}}}), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
