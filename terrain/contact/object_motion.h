#pragma once

#include <optional>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// Where an object stands: first scaled, then turned, then moved.
struct Pose {
    glm::dvec3 position{0.0};                 ///< Metres.
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< Of unit length; w comes first here.
    double scale = 1.0;                       ///< Positive; a growing object changes it.
};

/// A pose at a time.
struct MotionKey {
    double time_s = 0.0;
    Pose pose;
};

/// A wheel turns as far as it travels: no slip along its rolling direction, any slip sideways.
struct Rolling {
    double radius_m = 0.5;           ///< At scale 1.
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< In the object's frame, of unit length.
};

/// What decides an object's height.
enum class Ride {
    Path,    ///< The keys.
    Sink,    ///< It stands a given depth below the ground that it meets.
    Weight,  ///< It falls until the ground bears it (one way: the ground's stress, no bounce).
};

/// How one object moves. Between keys positions and scales go straight, rotations along the
/// shortest great circle; before the first and after the last key it stands still.
struct ObjectMotion {
    std::vector<MotionKey> keys;  ///< Times strictly grow.
    std::optional<Rolling> rolling;
    Ride ride = Ride::Path;
    double sink_m = 0.0;  ///< Of Ride::Sink.
    double from_s = 0.0;  ///< It is there only from here on...
    double to_s = 1e12;   ///< ...to here.
};

/// Throw InvalidInput unless there is a key, times strictly grow, every number is finite, scales
/// and the rolling radius are positive, and rotations and the axis are no zero vectors.
void check_motion(const ObjectMotion& motion);

/// It is part of the scene at this time.
bool is_present(const ObjectMotion& motion, double time_s);

/// The pose at a time, rolling included; the height is the keys' for any ride.
/// @pre  check_motion() passes.
Pose pose_at(const ObjectMotion& motion, double time_s);

glm::dmat4 matrix_of(const Pose& pose);

}  // namespace scree::terrain
