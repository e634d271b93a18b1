#include "terrain/contact/contact_force.h"

#include "base/error.h"
#include "terrain/contact/shapes.h"

#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr double kSize = 0.1;
constexpr CellGrid kGrid{{0, 0, 40, 40}, kSize};

// Flat ground at height 0 below a group of bodies.
struct Flat {
    explicit Flat(const CellWindow& window)
        : heights(window.width, window.height),
          mobility(window.width, window.height, 0.5F),
          ground{window, &heights, &mobility, kSize} {}
    FloatRaster heights;
    FloatRaster mobility;
    GroundUnder ground;
};

double sum_of(const FloatRaster& raster) {
    double sum = 0.0;
    for (const float value : raster)
        sum += value;
    return sum;
}

PressingBody body_of(const Underside& underside, const glm::dvec3& force, double mass,
                     const glm::dvec2& centre) {
    return {&underside, force, mass, centre};
}

TEST(ContactForce, SharesSumToTheObjectsForce) {
    const Underside ball = underside_of_sphere({2.02, 0.6, 1.97}, 0.8, kGrid);
    const PressingBody body = body_of(ball, {70, -30, -20}, 5, {2.02, 1.97});
    const Flat flat(ball.window);
    const ContactOptions options{.outward = Outward::Radial, .unit_stress = 1000};
    const ContactLoad out = contact_load({&body, 1}, flat.ground, options);
    const double unit = 1000 * kSize * kSize;  // newtons of one grid unit
    EXPECT_NEAR(out.bodies[0].drag_force.x, 70, 1e-9);
    EXPECT_NEAR(out.bodies[0].drag_force.y, -20, 1e-9);
    // The outward part has no direction in sum, for the ball stands almost on a centre's crossing.
    EXPECT_NEAR(out.bodies[0].outward_force, 0.5 * (30 + 5 * 9.81), 1e-9);
    EXPECT_NEAR(unit * sum_of(out.load.force_x), 70, 2.5);
    EXPECT_NEAR(unit * sum_of(out.load.force_z), -20, 2.5);
    EXPECT_NEAR(out.bodies[0].deepest_m, 0.2, 1e-3);
    EXPECT_NEAR(out.bodies[0].overlap_m3, M_PI * 0.04 * (0.8 - 0.2 / 3), 0.05 * 0.1);
}

// C.9 by hand: the force of a cell is sigma * (drag + kappa * load * outward).
TEST(ContactForce, IsTheShareOfEachCellByItsPenetration) {
    const glm::dvec3 centre(2.0, 0.6, 2.0);
    const Underside ball = underside_of_sphere(centre, 0.8, kGrid);
    const PressingBody body = body_of(ball, {8, 0, 3}, 4, {2.0, 2.0});
    const Flat flat(ball.window);
    const ContactOptions options{.outward = Outward::Radial, .unit_stress = 500};
    const Load load = contact_load({&body, 1}, flat.ground, options).load;
    double depths = 0.0;
    for (const float under : ball.heights)
        depths += under < 0.0F ? -static_cast<double>(under) : 0.0;
    for (const auto& [x, y] : {std::pair{8, 8}, {9, 6}, {11, 10}}) {
        const double depth = std::max(0.0F, -ball.heights(x, y));
        const glm::dvec2 outward = glm::normalize(
            glm::dvec2((ball.window.x + x + 0.5) * kSize, (ball.window.y + y + 0.5) * kSize) -
            glm::dvec2(2.0));
        const glm::dvec2 force =
            depth / depths * (glm::dvec2(8, 3) + 0.5 * 4 * 9.81 * outward) / (500 * kSize * kSize);
        EXPECT_NEAR(load.force_x(x, y), force.x, 1e-6);
        EXPECT_NEAR(load.force_z(x, y), force.y, 1e-6);
    }
    EXPECT_EQ(load.force_x(0, 8), 0.0F);
    EXPECT_EQ(load.underside, ball.heights);
}

TEST(ContactForce, BothOutwardDirectionsAgreeOnASphere) {
    const Underside ball = underside_of_sphere({2.0, 0.5, 2.0}, 0.8, kGrid);
    const PressingBody body = body_of(ball, {0, 0, 0}, 4, {2.0, 2.0});
    const Flat flat(ball.window);
    const Load radial = contact_load({&body, 1}, flat.ground, {.outward = Outward::Radial}).load;
    const Load surface = contact_load({&body, 1}, flat.ground, {.outward = Outward::Surface}).load;
    for (int y = 3; y < 13; ++y)
        for (int x = 3; x < 13; ++x)
            EXPECT_NEAR(surface.force_x(x, y), radial.force_x(x, y),
                        0.06 * std::abs(radial.force_x(x, y)) + 1e-4);
}

// A flat plate with one ridge: soil under the ridge's flank is pushed off it, not across it.
TEST(ContactForce, SurfacePushesUpTheFlanksOfALug) {
    Underside plate{{5, 5, 20, 20}, FloatRaster(20, 20, -0.05F), 400};
    for (int y = 0; y < 20; ++y) {
        plate.heights(5, y) = -0.15F;
        plate.heights(4, y) = plate.heights(6, y) = -0.10F;
    }
    const PressingBody body = body_of(plate, {0, 0, 0}, 10, {1.5, 1.5});
    const Flat flat(plate.window);
    const Load load = contact_load({&body, 1}, flat.ground, {}).load;
    EXPECT_LT(load.force_x(4, 10), 0.0F);
    EXPECT_GT(load.force_x(6, 10), 0.0F);  // against the way from the centre
    EXPECT_GT(load.force_x(15, 10), 0.0F);
    EXPECT_LT(load.force_x(7, 10), 0.01F);
}

TEST(ContactForce, SeveralBodiesAddUp) {
    const Underside one = underside_of_sphere({1.25, 0.4, 2.03}, 0.6, kGrid);
    const Underside two = underside_of_sphere({2.02, 0.3, 2.13}, 0.5, kGrid);
    const PressingBody bodies[] = {body_of(one, {5, 0, 0}, 2, {1.2, 2.0}),
                                   body_of(two, {0, -9, 4}, 3, {2.0, 2.1})};
    const CellWindow window = common_window(bodies);
    EXPECT_EQ(window, (CellWindow{6, 14, 20, 13}));
    const Flat flat(window);
    const ContactLoad both = contact_load(bodies, flat.ground);
    const ContactLoad first = contact_load({bodies, 1}, flat.ground);
    const ContactLoad second = contact_load({bodies + 1, 1}, flat.ground);
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x) {
            EXPECT_NEAR(both.load.force_x(x, y),
                        first.load.force_x(x, y) + second.load.force_x(x, y), 1e-7);
            EXPECT_EQ(both.load.underside(x, y),
                      std::min(first.load.underside(x, y), second.load.underside(x, y)));
        }
    EXPECT_EQ(both.bodies[1].cells, second.bodies[0].cells);
}

// A column of soil inside the ball takes most of its force without a yield, and no more with one.
TEST(ContactForce, SoilYieldsWhereTheForceIsTooGreat) {
    const Underside ball = underside_of_sphere({2.02, 0.6, 1.97}, 0.8, kGrid);
    const PressingBody body = body_of(ball, {900, 0, 0}, 0, {2.02, 1.97});
    Flat flat(ball.window);
    flat.heights(5, 9) = 0.5F;
    const ContactOptions free{.unit_stress = 1000};
    const ContactLoad spiked = contact_load({&body, 1}, flat.ground, free);
    EXPECT_GT(spiked.load.force_x(5, 9), 3.0F);
    EXPECT_EQ(spiked.bodies[0].unspent_force, 0.0);
    const ContactOptions yielding{.unit_stress = 1000, .yield = 0.5};
    const ContactLoad out = contact_load({&body, 1}, flat.ground, yielding);
    EXPECT_NEAR(out.load.force_x(5, 9), 0.5, 1e-6);
    EXPECT_NEAR(10 * sum_of(out.load.force_x) + out.bodies[0].unspent_force, 900, 1e-3);
}

// F.4 as printed: F = p * mobility * F_obj, neither shared out nor moved by weight.
TEST(ContactForce, LiteralRuleIsAsPrinted) {
    const Underside ball = underside_of_sphere({2.0, 0.5, 2.0}, 0.8, kGrid);
    const PressingBody body = body_of(ball, {40, -100, -10}, 50, {2.0, 2.0});
    const Flat flat(ball.window);
    const ContactOptions options{.reading = Reading::Literal, .unit_stress = 1 / (kSize * kSize)};
    const Load load = contact_load({&body, 1}, flat.ground, options).load;
    const double depth = -ball.heights(9, 7);
    EXPECT_NEAR(load.force_x(9, 7), depth * 0.5 * 40, 1e-6);
    EXPECT_NEAR(load.force_z(9, 7), depth * 0.5 * -10, 1e-6);
    EXPECT_EQ(load.force_x(0, 8), 0.0F);
}

TEST(ContactForce, ABodyInTheAirPressesNowhere) {
    const Underside ball = underside_of_sphere({2.0, 3.0, 2.0}, 0.8, kGrid);
    const PressingBody body = body_of(ball, {40, 0, 0}, 50, {2.0, 2.0});
    const Flat flat(ball.window);
    const ContactLoad out = contact_load({&body, 1}, flat.ground);
    EXPECT_EQ(out.bodies[0].cells, 0);
    EXPECT_EQ(sum_of(out.load.force_x), 0.0);
    EXPECT_FALSE(out.bodies[0].smaller_than_cell);
    const Underside grain = underside_of_sphere({2.0, 0.0, 2.0}, 0.01, kGrid);
    const PressingBody small = body_of(grain, {0, 0, 0}, 1, {2.0, 2.0});
    const Flat below(grain.window);
    EXPECT_TRUE(contact_load({&small, 1}, below.ground).bodies[0].smaller_than_cell);
}

TEST(ContactForceErrors, SayWhatIsWrong) {
    const Underside ball = underside_of_sphere({2.0, 0.5, 2.0}, 0.8, kGrid);
    const Flat flat(ball.window);
    PressingBody body = body_of(ball, {0, 0, 0}, -1, {2.0, 2.0});
    EXPECT_THAT(
        [&] {
            contact_load({&body, 1}, flat.ground);
        },
        testing::ThrowsMessage<InvalidInput>(HasSubstr("mass -1 kg")));
    body.mass = std::nan("");
    EXPECT_THROW(contact_load({&body, 1}, flat.ground), InvalidInput);
    body.mass = 1;
    GroundUnder other = flat.ground;
    other.window.width += 1;
    EXPECT_THROW(contact_load({&body, 1}, other), InvalidInput);
    other = flat.ground;
    other.mobility = nullptr;
    EXPECT_NO_THROW(contact_load({&body, 1}, other));
    EXPECT_THROW(contact_load({&body, 1}, other, {.reading = Reading::Literal}), InvalidInput);
    EXPECT_THROW(contact_load({&body, 1}, flat.ground, {.spread = -1}), InvalidOption);
    body.underside = nullptr;
    EXPECT_THROW(contact_load({&body, 1}, flat.ground), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
