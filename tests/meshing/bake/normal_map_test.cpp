#include "meshing/bake/normal_map.h"

#include "base/error.h"
#include "meshing/bake/height_bake.h"
#include "tests/support/placed_rocks.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

vision::HeightImage plane(double slope_x, double slope_down) {
    vision::HeightImage heights{FloatRaster(9, 7), 0.01};
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x)
            heights.metres(x, y) = static_cast<float>(0.01 * (slope_x * x + slope_down * y));
    return heights;
}

glm::dvec3 decoded(glm::u8vec3 c) {
    return glm::dvec3(c) / 127.5 - 1.0;
}

TEST(NormalMap, FlatGroundPointsStraightOut) {
    const Photo map = normal_map(plane(0, 0));
    for (const glm::u8vec3& c : map)
        EXPECT_EQ(c, glm::u8vec3(128, 128, 255));
}

TEST(NormalMap, PlanesHaveTheirNormalEverywhereInTheGltfConvention) {
    for (const auto& [right, down] : {std::pair{0.5, 0.0}, {0.0, 0.5}, {-2.0, 1.0}}) {
        const Photo map = normal_map(plane(right, down));
        // A slope that rises to the right leans left; one that rises down the rows leans up.
        const glm::dvec3 wanted = glm::normalize(glm::dvec3(-right, down, 1.0));
        for (const glm::u8vec3& c : map)
            EXPECT_LT(glm::distance(decoded(c), wanted), 0.01);
    }
}

TEST(NormalMap, TrueScaleMattersNotTheUnitOfThePixel) {
    vision::HeightImage heights = plane(1.0, 0.0);
    heights.metres_per_pixel *= 2.0;  // the same rise over twice the way
    EXPECT_LT(glm::distance(decoded(normal_map(heights)(4, 3)),
                            glm::normalize(glm::dvec3(-0.5, 0.0, 1.0))),
              0.01);
    EXPECT_LT(glm::distance(decoded(normal_map(heights, {.strength = 2.0})(4, 3)),
                            glm::normalize(glm::dvec3(-1.0, 0.0, 1.0))),
              0.01);
}

TEST(NormalMap, DomeHasTheSpheresNormals) {
    vision::RockSet set = test::empty_picture(101, 101, 0.001);
    vision::Rock rock;
    rock.outline.centre = {50.5, 50.5};
    rock.outline.radii.fill(45.0F);
    rock.depth = 45.0F;
    set.rocks.push_back(rock);
    const Photo map = normal_map(bake_displacement(set));
    for (int y = 20; y < 80; ++y)
        for (int x = 20; x < 80; ++x) {
            const double dx = x - 50.0;
            const double dy = y - 50.0;
            const glm::dvec3 wanted =
                glm::dvec3(dx, -dy, std::sqrt(45.0 * 45.0 - dx * dx - dy * dy)) / 45.0;
            ASSERT_LT(glm::distance(decoded(map(x, y)), wanted), 0.015) << x << ", " << y;
        }
}

TEST(NormalMap, WrappingMapsShiftWithTheirHeights) {
    vision::HeightImage heights{FloatRaster(16, 12), 0.01};
    Rng rng({.seed = 3});
    for (float& h : heights.metres)
        h = static_cast<float>(rng.uniform(0.0, 0.02));
    vision::HeightImage shifted = heights;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            shifted.metres((x + 5) % 16, (y + 7) % 12) = heights.metres(x, y);
    const Photo map = normal_map(heights, {.wraps = true});
    const Photo moved = normal_map(shifted, {.wraps = true});
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            ASSERT_EQ(moved((x + 5) % 16, (y + 7) % 12), map(x, y));
}

TEST(NormalMap, OnePixelAndOneLineAreFlatAcross) {
    EXPECT_EQ(normal_map({FloatRaster(1, 1, 0.3F), 0.01})(0, 0), glm::u8vec3(128, 128, 255));
    EXPECT_EQ(normal_map({FloatRaster(1, 9, 0.3F), 0.01}, {.wraps = true})(0, 8),
              glm::u8vec3(128, 128, 255));
}

TEST(NormalMapErrors, NameTheScaleOrTheValue) {
    EXPECT_THAT(
        [] {
            normal_map({FloatRaster(2, 2), 0.0});
        },
        testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("scale is 0")));
    EXPECT_THROW(normal_map({FloatRaster(), 0.01}), InvalidInput);
    EXPECT_THROW(normal_map({FloatRaster(2, 2, NAN), 0.01}), InvalidInput);
    EXPECT_THROW(normal_map(plane(0, 0), {.strength = 0.0}), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
