#include "vision/data/overlay.h"

#include "base/error.h"
#include "base/parallel.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::vision {
namespace {

RockSet one_disc(double radius, float confidence) {
    RockSet set{.image = "a.png", .width = 100, .height = 80, .method = "drawn", .rocks = {}};
    Rock rock;
    rock.outline.centre = {50, 40};
    rock.outline.radii.fill(static_cast<float>(radius));
    rock.outline.confidence = confidence;
    rock.depth = static_cast<float>(radius);
    set.rocks.push_back(rock);
    return set;
}

const Photo& grey() {
    static const Photo photo(100, 80, glm::u8vec3(128));
    return photo;
}

TEST(Overlay, DrawsTheOutlineAndNothingElse) {
    const Photo overlay = draw_overlay(grey(), one_disc(20, 1.0F), {.dimming = 0});
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 100; ++x) {
            const double distance = glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(50, 40));
            if (std::abs(distance - 20) > 4) {
                ASSERT_EQ(overlay(x, y), glm::u8vec3(128)) << x << ", " << y;
            }
        }
    const glm::u8vec3 right = overlay(69, 40);
    const glm::u8vec3 left = overlay(30, 40);
    EXPECT_GT(right.y, right.x + 60);  // turquoise
    EXPECT_GT(left.y, left.x + 60);
}

TEST(Overlay, ColourTellsTheConfidence) {
    const glm::u8vec3 doubtful = draw_overlay(grey(), one_disc(20, 0.0F))(69, 40);
    const glm::u8vec3 sure = draw_overlay(grey(), one_disc(20, 1.0F))(69, 40);
    EXPECT_GT(doubtful.x, doubtful.y + 60);
    EXPECT_GT(sure.y, sure.x + 60);
}

TEST(Overlay, DimsThePhotograph) {
    const RockSet none{.image = "a.png", .width = 100, .height = 80, .method = "none", .rocks = {}};
    const Photo overlay = draw_overlay(grey(), none, {.dimming = 0.5});
    for (const glm::u8vec3& colour : overlay)
        ASSERT_EQ(colour, glm::u8vec3(64));
}

TEST(Overlay, TakesRocksThatReachFarOutside) {
    RockSet set = one_disc(900000, 0.5F);
    set.rocks.push_back(one_disc(1, 0.5F).rocks.front());
    set.rocks.back().outline.centre = {-50, 4000};
    const Photo overlay = draw_overlay(grey(), set, {.colour = OutlineColour::Hue});
    EXPECT_EQ(overlay(50, 40), draw_overlay(grey(), one_disc(20, 1))(50, 40));
}

TEST(Overlay, GivesTheSamePictureForAnyThreadCount) {
    const Photo parallel = draw_overlay(grey(), one_disc(20, 0.3F));
    const ThreadLimit one(1);
    EXPECT_EQ(parallel, draw_overlay(grey(), one_disc(20, 0.3F)));
}

TEST(OverlayErrors, NameBothSizes) {
    EXPECT_THAT([] { draw_overlay(Photo(10, 20), one_disc(20, 1)); },
                testing::ThrowsMessage<InvalidInput>(
                    testing::AllOf(testing::HasSubstr("10 x 20"), testing::HasSubstr("100 x 80"))));
    EXPECT_THROW(draw_overlay(grey(), one_disc(-1, 1)), InvalidInput);
    EXPECT_THROW(draw_overlay(grey(), one_disc(1, 1), {.dimming = 2}), InvalidOption);
}

}  // namespace
}  // namespace scree::vision
