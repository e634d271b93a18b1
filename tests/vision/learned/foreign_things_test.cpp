#include "testdata/gravel_scene.h"
#include "testdata/laid_things.h"
#include "tests/vision/learned/found_labels.h"

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

struct Claim {
    int thing = 0;  ///< Pixels.
    int rock = 0;   ///< Those of them that were taken for rock.

    double share() const { return static_cast<double>(rock) / thing; }
};

void add_claim(Claim& claim, const LabelMap& found, const Mask& thing) {
    for (int y = 0; y < found.height(); ++y)
        for (int x = 0; x < found.width(); ++x) {
            if (thing(x, y) == 0)
                continue;
            ++claim.thing;
            claim.rock += found(x, y) > 0 ? 1 : 0;
        }
}

test::SceneOptions scene_of(std::uint64_t seed) {
    return {
        .width = 360, .height = 300, .coverage = 1.2, .least = 12, .greatest = 70, .seed = seed};
}

TEST(ForeignThings, RulersAreNoRocks) {
    Claim claim;
    std::uint64_t seed = 20;
    for (const glm::dvec2 half : {glm::dvec2(90.0, 14.0), {130.0, 30.0}}) {
        Photo photo = make_gravel_scene(scene_of(++seed)).photo;
        const double azimuth = 0.7 * static_cast<double>(seed);
        const Mask ruler = test::lay_ruler(
            photo, {.centre = {180.0, 150.0}, .half_size = half, .azimuth = azimuth});
        add_claim(claim, found_labels(photo), ruler);
    }
    EXPECT_GT(claim.thing, 15000);
    EXPECT_LT(claim.share(), 0.2);
}

// Of several sizes and colours, on heaps that are found well without a hand.
TEST(ForeignThings, HandsAreNoRocks) {
    struct Case {
        double finger, azimuth;
        glm::dvec3 skin;
    };
    Claim claim;
    std::uint64_t seed = 10;
    for (const Case& c : {Case{9.0, -1.6, {205, 150, 120}}, Case{13.0, -0.7, {225, 185, 160}},
                          Case{17.0, -2.3, {105, 70, 50}}}) {
        Photo photo = make_gravel_scene(scene_of(++seed)).photo;
        const Mask hand = test::lay_hand(
            photo,
            {.knuckles = {180.0, 140.0}, .finger = c.finger, .azimuth = c.azimuth, .skin = c.skin});
        add_claim(claim, found_labels(photo), hand);
    }
    EXPECT_GT(claim.thing, 25000);
    EXPECT_LT(claim.share(), 0.4);  // 0.28; 0.9 before hands were laid over what it learns from
}

}  // namespace
}  // namespace scree::vision
