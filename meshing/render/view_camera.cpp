#include "meshing/render/view_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace scree::meshing {
namespace {

constexpr float kMargin = 0.02F;  // of the picture's width, on every side
constexpr float kTallest = 1.5F;  // height of a picture, in widths

std::array<glm::vec3, 8> box_corners(const std::vector<glm::vec3>& points) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    low.y = std::max(low.y, std::min(0.0F, high.y));  // what lies under the ground is not seen
    std::array<glm::vec3, 8> corners{};
    for (std::size_t k = 0; k < 8; ++k)
        corners[k] = {(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                      (k & 4) != 0 ? high.z : low.z};
    return corners;
}

}  // namespace

glm::vec3 sky_direction(double azimuth, double elevation) {
    const double a = glm::radians(azimuth);
    const double e = glm::radians(elevation);
    return glm::vec3(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
}

glm::vec3 ViewCamera::project(const glm::vec3& point) const {
    const glm::vec3 p = point - centre;
    const float nearness = 1.0F / (distance - glm::dot(p, back));
    return {(glm::dot(p, right) * nearness - origin.x) * scale,
            (origin.y - glm::dot(p, up) * nearness) * scale, nearness};
}

ViewCamera fit_camera(const std::vector<glm::vec3>& points, const CameraPose& pose) {
    const auto corners = box_corners(points);
    ViewCamera camera;
    camera.back = sky_direction(pose.azimuth, pose.elevation);
    camera.right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), camera.back));
    camera.up = glm::cross(camera.back, camera.right);
    camera.centre = 0.5F * (corners.front() + corners.back());
    const float reach = std::max(glm::distance(corners.front(), corners.back()), 1e-9F);
    const auto tangent = static_cast<float>(std::tan(glm::radians(0.5 * pose.field_of_view)));
    camera.distance = 0.1F * reach;
    for (const glm::vec3& corner : corners) {
        const glm::vec3 p = corner - camera.centre;
        const float across = std::max(std::abs(glm::dot(p, camera.right)), 0.05F * reach);
        camera.distance = std::max(camera.distance, glm::dot(p, camera.back) + across / tangent);
    }
    glm::vec2 low(std::numeric_limits<float>::max());
    glm::vec2 high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& corner : corners) {
        const glm::vec3 p = corner - camera.centre;
        const glm::vec2 seen = glm::vec2(glm::dot(p, camera.right), glm::dot(p, camera.up)) /
                               (camera.distance - glm::dot(p, camera.back));
        low = glm::min(low, seen);
        high = glm::max(high, seen);
    }
    const auto width = static_cast<float>(pose.width);
    const auto margin = kMargin * width;
    const glm::vec2 size = glm::max(high - low, glm::vec2(1e-6F));
    camera.scale =
        std::min((width - 2 * margin) / size.x, (kTallest * width - 2 * margin) / size.y);
    camera.width = pose.width;
    camera.height = std::max(8, static_cast<int>(std::ceil(size.y * camera.scale + 2 * margin)));
    const glm::vec2 frame = glm::vec2(width, static_cast<float>(camera.height)) / camera.scale;
    const glm::vec2 middle = 0.5F * (low + high);
    camera.origin = {middle.x - 0.5F * frame.x, middle.y + 0.5F * frame.y};
    return camera;
}

}  // namespace scree::meshing
