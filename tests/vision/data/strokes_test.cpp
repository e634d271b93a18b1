#include "vision/data/strokes.h"

#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scree::vision {
namespace {

constexpr glm::u8vec3 kWhite(255);

float distance_to(const Stroke& stroke, glm::vec2 p) {
    float least = 1e30F;
    glm::vec2 last = stroke.points.back();
    for (const glm::vec2& next : stroke.points) {
        const glm::vec2 along = next - last;
        const float square = glm::dot(along, along);
        const float t =
            square > 0.0F ? std::clamp(glm::dot(p - last, along) / square, 0.0F, 1.0F) : 0.0F;
        least = std::min(least, glm::distance(p, last + t * along));
        last = next;
    }
    return least;
}

Stroke ring(glm::vec2 centre, float radius, int n, glm::u8vec3 colour) {
    Stroke stroke{{}, colour};
    for (int k = 0; k < n; ++k) {
        const float a = 6.2831853F * static_cast<float>(k) / static_cast<float>(n);
        stroke.points.push_back(centre + radius * glm::vec2(std::cos(a), std::sin(a)));
    }
    return stroke;
}

TEST(Strokes, ShadeAPixelByItsDistance) {
    for (const float width : {1.0F, 2.0F, 7.0F}) {
        const Stroke stroke = ring({70.3F, 61.8F}, 40.2F, 90, kWhite);
        Photo picture(140, 150);
        draw_strokes(picture, {&stroke, 1}, width);
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x) {
                const float distance = distance_to(
                    stroke, {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F});
                const float share = std::clamp(0.5F * width + 0.5F - distance, 0.0F, 1.0F);
                ASSERT_NEAR(picture(x, y).x, 255.0F * share, 1.5F) << x << ", " << y;
            }
    }
}

TEST(Strokes, LieOnTopOfEarlierOnes) {
    const Stroke both[] = {ring({20, 20}, 10, 40, {255, 0, 0}),
                           ring({30, 20}, 10, 40, {0, 255, 0})};
    Photo picture(50, 40);
    draw_strokes(picture, both, 3.0F);
    EXPECT_EQ(picture(24, 11), glm::u8vec3(0, 255, 0));  // where the rings cross
    EXPECT_EQ(picture(9, 19), glm::u8vec3(255, 0, 0));
}

TEST(Strokes, MayLieOutsideOrBePoints) {
    const Stroke strokes[] = {ring({-50, 20}, 10, 12, kWhite),
                              ring({20, 500}, 10, 12, kWhite),
                              {{}, kWhite},
                              ring({9e5F, 20}, 1, 12, kWhite)};
    Photo picture(40, 40);
    draw_strokes(picture, strokes, 3.0F);
    EXPECT_EQ(picture, Photo(40, 40));
    const Stroke point{{{10.5F, 10.5F}}, kWhite};
    draw_strokes(picture, {&point, 1}, 3.0F);
    EXPECT_EQ(picture(10, 10), kWhite);
    EXPECT_EQ(picture(14, 10), glm::u8vec3(0));
}

TEST(Strokes, AreTheSameForAnyThreadCount) {
    std::vector<Stroke> strokes;
    for (std::uint64_t i = 0; i < 200; ++i) {
        Rng random({.seed = 7, .cell = i});
        const glm::vec2 centre(random.uniform(0, 300), random.uniform(0, 300));
        strokes.push_back(ring(centre, static_cast<float>(random.uniform(2, 62)), 36,
                               glm::u8vec3(static_cast<std::uint8_t>(i))));
    }
    Photo parallel(300, 300);
    draw_strokes(parallel, strokes, 2.0F);
    const ThreadLimit one(1);
    Photo serial(300, 300);
    draw_strokes(serial, strokes, 2.0F);
    EXPECT_EQ(parallel, serial);
}

}  // namespace
}  // namespace scree::vision
