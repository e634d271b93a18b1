#include "terrain/contact/object_motion.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_geometric.hpp>
#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace scree::terrain {
namespace {

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_key(const MotionKey& key, std::size_t index) {
    const Pose& pose = key.pose;
    if (!std::isfinite(key.time_s) || !is_finite(pose.position))
        fail<InvalidInput>("motion key ", index, " has a time or place that is no number");
    if (!(pose.scale > 0.0) || !std::isfinite(pose.scale))
        fail<InvalidInput>("motion key ", index, " has scale ", pose.scale,
                           ", it must be positive");
    const double length = glm::length(pose.rotation);
    if (!std::isfinite(length) || std::abs(length - 1.0) > 1e-6)
        fail<InvalidInput>("motion key ", index, " has a rotation of length ", length,
                           ", it must be 1");
}

Pose between(const MotionKey& a, const MotionKey& b, double part) {
    return {glm::mix(a.pose.position, b.pose.position, part),
            glm::normalize(glm::slerp(a.pose.rotation, b.pose.rotation, part)),
            a.pose.scale + part * (b.pose.scale - a.pose.scale)};
}

// Integral of 1 / scale over the part [0, part] of a segment whose scale goes straight.
double inverse_scale(double first, double last, double part) {
    const double change = last - first;
    if (std::abs(change) < 1e-9 * first)
        return part / first;
    return std::log1p(change * part / first) / change;
}

// Angle by which a wheel turns over the first `part` of a segment, radians.
double rolled(const MotionKey& a, const MotionKey& b, double part, const Rolling& rolling) {
    const glm::dquat middle = glm::slerp(a.pose.rotation, b.pose.rotation, 0.5 * part);
    const glm::dvec3 axis = glm::normalize(middle * rolling.axis);
    const glm::dvec3 ahead = glm::cross(axis, glm::dvec3(0, 1, 0));  // moves the contact backwards
    const double length = glm::length(ahead);
    if (length < 1e-9)
        return 0.0;  // a wheel that lies on its side does not roll
    const double travel = glm::dot(b.pose.position - a.pose.position, ahead / length);
    return travel / rolling.radius_m * inverse_scale(a.pose.scale, b.pose.scale, part);
}

}  // namespace

void check_motion(const ObjectMotion& motion) {
    if (motion.keys.empty())
        fail<InvalidInput>("the motion has no key, one at least says where the object stands");
    for (std::size_t i = 0; i < motion.keys.size(); ++i) {
        check_key(motion.keys[i], i);
        if (i > 0 && !(motion.keys[i].time_s > motion.keys[i - 1].time_s))
            fail<InvalidInput>("motion key ", i, " is at ", motion.keys[i].time_s,
                               " s, not after the key before it");
    }
    if (motion.rolling &&
        (!(motion.rolling->radius_m > 0.0) || !std::isfinite(motion.rolling->radius_m) ||
         !is_finite(motion.rolling->axis) || !(glm::length(motion.rolling->axis) > 1e-9)))
        fail<InvalidInput>("the rolling radius is ", motion.rolling->radius_m,
                           " m, it must be positive and its axis no zero vector");
    if (!std::isfinite(motion.sink_m) || !std::isfinite(motion.from_s) ||
        !std::isfinite(motion.to_s))
        fail<InvalidInput>("the motion's sink or times are no numbers");
}

bool is_present(const ObjectMotion& motion, double time_s) {
    return time_s >= motion.from_s && time_s <= motion.to_s;
}

Pose pose_at(const ObjectMotion& motion, double time_s) {
    const auto& keys = motion.keys;
    double angle = 0.0;
    Pose pose = keys.front().pose;
    for (std::size_t i = 0; i + 1 < keys.size() && keys[i].time_s < time_s; ++i) {
        const double span = keys[i + 1].time_s - keys[i].time_s;
        const double part = std::min(1.0, (time_s - keys[i].time_s) / span);
        pose = between(keys[i], keys[i + 1], part);
        if (motion.rolling)
            angle += rolled(keys[i], keys[i + 1], part, *motion.rolling);
    }
    if (motion.rolling)
        pose.rotation = glm::normalize(pose.rotation *
                                       glm::angleAxis(angle, glm::normalize(motion.rolling->axis)));
    return pose;
}

glm::dmat4 matrix_of(const Pose& pose) {
    glm::dmat4 matrix = glm::mat4_cast(pose.rotation);
    for (int column = 0; column < 3; ++column)
        matrix[column] *= pose.scale;
    matrix[3] = glm::dvec4(pose.position, 1.0);
    return matrix;
}

}  // namespace scree::terrain
