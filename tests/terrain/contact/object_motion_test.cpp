#include "terrain/contact/object_motion.h"

#include "base/error.h"

#include <cmath>
#include <numbers>

#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

MotionKey key(double time, const glm::dvec3& place, double scale = 1.0) {
    return {time, {place, {1, 0, 0, 0}, scale}};
}

TEST(ObjectMotion, GoesStraightBetweenKeysAndStandsOutside) {
    const ObjectMotion motion{.keys = {key(1, {0, 0, 0}), key(3, {4, 2, 0}, 3), key(4, {4, 2, 8})},
                              .rolling = {}};
    EXPECT_EQ(pose_at(motion, 0).position, glm::dvec3(0));
    EXPECT_NEAR(glm::distance(pose_at(motion, 2).position, {2, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(pose_at(motion, 2).scale, 2, 1e-12);
    EXPECT_NEAR(glm::distance(pose_at(motion, 3.25).position, {4, 2, 2}), 0, 1e-12);
    EXPECT_EQ(pose_at(motion, 99).position, glm::dvec3(4, 2, 8));
}

TEST(ObjectMotion, TurnsAlongTheShortestArc) {
    ObjectMotion motion{.keys = {key(0, {0, 0, 0}), key(1, {0, 0, 0})}, .rolling = {}};
    motion.keys[1].pose.rotation = glm::angleAxis(kPi / 2, glm::dvec3(0, 1, 0));
    const glm::dvec3 turned = pose_at(motion, 0.5).rotation * glm::dvec3(1, 0, 0);
    EXPECT_NEAR(glm::distance(turned, {std::sqrt(0.5), 0, -std::sqrt(0.5)}), 0, 1e-12);
}

// Rolling without slip: the point of a wheel that touches the ground stands still.
TEST(ObjectMotion, AWheelRollsWithoutSlipping) {
    const double radius = 0.4;
    for (const glm::dvec3 ahead : {glm::dvec3(1, 0, 0), {-1, 0, 0}}) {
        const ObjectMotion motion{
            .keys = {key(0, {0, radius, 0}), key(2, 3.0 * ahead + glm::dvec3(0, radius, 0))},
            .rolling = Rolling{radius, {0, 0, 1}}};
        const double time = 0.7;
        const double step = 1e-6;
        const Pose now = pose_at(motion, time);
        const glm::dvec3 in_wheel =
            glm::inverse(now.rotation) * (glm::dvec3(now.position.x, 0, 0) - now.position);
        const Pose next = pose_at(motion, time + step);
        const glm::dvec3 contact = next.position + next.rotation * in_wheel;
        EXPECT_LT(std::abs(contact.x - now.position.x) / step, 1e-5);
        // A whole turn takes one circumference.
        const Pose whole = pose_at(motion, 2 * 2 * kPi * radius / 3);
        EXPECT_NEAR(std::abs(whole.rotation.w), 1.0, 1e-9);
    }
}

TEST(ObjectMotion, AGrowingWheelTurnsByTheIntegralOfItsRadius) {
    const ObjectMotion motion{.keys = {key(0, {0, 0, 0}, 1), key(1, {2, 0, 0}, 3)},
                              .rolling = Rolling{0.5, {0, 0, 1}}};
    double angle = 0.0;
    for (int i = 0; i < 10000; ++i)
        angle -= 2e-4 / (0.5 * (1 + 2 * (i + 0.5) / 10000));
    const glm::dvec3 expected(std::cos(angle), std::sin(angle), 0);
    const Pose end = pose_at(motion, 1);
    EXPECT_NEAR(glm::distance(end.rotation * glm::dvec3(1, 0, 0), expected), 0, 1e-6);
}

TEST(ObjectMotion, AWheelOnItsSideOrSlippingSidewaysDoesNotTurn) {
    ObjectMotion motion{.keys = {key(0, {0, 0, 0}), key(1, {2, 0, 0})},
                        .rolling = Rolling{0.5, {0, 1, 0}}};
    EXPECT_NEAR(std::abs(pose_at(motion, 1).rotation.w), 1, 1e-12);
    motion.rolling = Rolling{0.5, {1, 0, 0}};
    EXPECT_NEAR(std::abs(pose_at(motion, 1).rotation.w), 1, 1e-12);
}

TEST(ObjectMotion, MatrixScalesThenTurnsThenMoves) {
    const Pose pose{{1, 2, 3}, glm::angleAxis(kPi / 2, glm::dvec3(0, 0, 1)), 2};
    const glm::dvec4 point = matrix_of(pose) * glm::dvec4(1, 0, 0, 1);
    EXPECT_NEAR(glm::distance(glm::dvec3(point), {1, 4, 3}), 0, 1e-12);
}

TEST(ObjectMotion, IsThereInItsTimeAlone) {
    const ObjectMotion motion{.keys = {key(0, {0, 0, 0})}, .rolling = {}, .from_s = 1, .to_s = 2};
    EXPECT_FALSE(is_present(motion, 0.9));
    EXPECT_TRUE(is_present(motion, 1.0));
    EXPECT_FALSE(is_present(motion, 2.1));
}

TEST(ObjectMotionErrors, NameTheKey) {
    ObjectMotion motion;
    EXPECT_THROW(check_motion(motion), InvalidInput);
    motion.keys = {key(0, {0, 0, 0}), key(0, {1, 0, 0})};
    EXPECT_THAT([&] { check_motion(motion); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("key 1 is at 0 s")));
    motion.keys = {key(0, {0, 0, 0}, -2)};
    EXPECT_THAT([&] { check_motion(motion); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("key 0 has scale -2")));
    motion.keys = {key(0, {std::nan(""), 0, 0})};
    EXPECT_THROW(check_motion(motion), InvalidInput);
    motion.keys = {key(0, {0, 0, 0})};
    motion.keys[0].pose.rotation = {0, 0, 0, 0};
    EXPECT_THROW(check_motion(motion), InvalidInput);
    motion.keys = {key(0, {0, 0, 0})};
    motion.rolling = Rolling{0, {0, 0, 1}};
    EXPECT_THROW(check_motion(motion), InvalidInput);
    motion.rolling = Rolling{1, {0, 0, 0}};
    EXPECT_THROW(check_motion(motion), InvalidInput);
}

}  // namespace
}  // namespace scree::terrain
