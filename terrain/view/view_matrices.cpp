#include "terrain/view/view_matrices.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

std::array<glm::vec3, 8> corners_of(const ViewBox& box) {
    std::array<glm::vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = {(i & 1U) != 0 ? box.high.x : box.low.x,
                      (i & 2U) != 0 ? box.high.y : box.low.y,
                      (i & 4U) != 0 ? box.high.z : box.low.z};
    return corners;
}

glm::vec3 upright(const glm::vec3& direction) {
    return std::abs(direction.y) > 0.999F ? glm::vec3(0.0F, 0.0F, -1.0F)
                                          : glm::vec3(0.0F, 1.0F, 0.0F);
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

ViewBox bounds_of(const std::vector<TerrainObject>& objects, const glm::vec3& fallback) {
    ViewBox box{fallback, fallback};
    bool first = true;
    for (const TerrainObject& object : objects) {
        if (object.mesh == nullptr)
            fail<InvalidInput>("an object of the frame has no mesh");
        for (const glm::vec3& position : object.mesh->positions) {
            const glm::vec3 at(object.world_from_object * glm::vec4(position, 1.0F));
            if (!finite(at))
                fail<InvalidInput>("an object of the frame stands at no finite place");
            if (first)
                box = {at, at};
            first = false;
            box.add(at);
        }
    }
    return box;
}

glm::mat4 clip_from_world(const TerrainCamera& camera, double aspect, const ViewBox& scene) {
    const glm::vec3 ahead = camera.target - camera.eye;
    const float distance = glm::length(ahead);
    if (!(distance > 0.0F) || !finite(camera.eye) || !finite(camera.target))
        fail<InvalidInput>("the camera stands at (", camera.eye.x, ", ", camera.eye.y, ", ",
                           camera.eye.z, ") and looks at no other place");
    if (!(camera.field_of_view_deg >= 1.0) || !(camera.field_of_view_deg <= 150.0))
        fail<InvalidInput>("the camera's field of view is ", camera.field_of_view_deg,
                           " deg, it must be in [1, 150]");
    float nearest = distance;
    float farthest = 0.0F;
    for (const glm::vec3& corner : corners_of(scene)) {
        const float along = glm::dot(corner - camera.eye, ahead) / distance;
        nearest = std::min(nearest, along);
        farthest = std::max(farthest, along);
    }
    farthest = std::max(farthest * 1.02F, distance);
    nearest = std::clamp(nearest * 0.9F, farthest * 1e-3F, farthest * 0.9F);
    return glm::perspective(glm::radians(static_cast<float>(camera.field_of_view_deg)),
                            static_cast<float>(aspect), nearest, farthest) *
           glm::lookAt(camera.eye, camera.target, upright(ahead / distance));
}

glm::mat4 shadow_from_world(const glm::vec3& sun, const ViewBox& casters, const ViewBox& ground) {
    const glm::mat4 turn = glm::lookAt(sun, glm::vec3(0.0F), upright(sun));
    const auto turned = [&](const ViewBox& box) {
        const auto corners = corners_of(box);
        const glm::vec3 first(turn * glm::vec4(corners[0], 1.0F));
        ViewBox out{first, first};
        for (const glm::vec3& corner : corners)
            out.add(glm::vec3(turn * glm::vec4(corner, 1.0F)));
        return out;
    };
    const ViewBox seen = turned(casters);
    const ViewBox floor = turned(ground);
    const glm::vec3 size = seen.high - seen.low;
    // Without objects the casters are a point, and a margin below its digits would be none.
    const float margin = 0.02F * std::max({size.x, size.y, 1e-3F * (floor.high.x - floor.low.x)});
    const glm::mat4 clip = glm::ortho(
        seen.low.x - margin, seen.high.x + margin, seen.low.y - margin, seen.high.y + margin,
        -(seen.high.z + margin), -(std::min(seen.low.z, floor.low.z) - margin));
    const glm::mat4 half =
        glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(0.5F)), glm::vec3(0.5F));
    return half * clip * turn;
}

glm::mat4 under_from_world(const ViewBox& objects) {
    const glm::vec3 size = glm::max(objects.high - objects.low, glm::vec3(1e-6F));
    glm::mat4 map(0.0F);
    map[0][0] = 1.0F / size.x;
    map[1][2] = 1.0F / size.y;
    map[2][1] = 1.0F / size.z;
    map[3] =
        glm::vec4(-objects.low.x / size.x, -objects.low.z / size.z, -objects.low.y / size.y, 1.0F);
    return map;
}

glm::vec3 sun_direction(const TerrainLight& light) {
    if (!(light.elevation_deg > 0.0) || !(light.elevation_deg <= 90.0) ||
        !std::isfinite(light.azimuth_deg))
        fail<InvalidInput>("the sun stands ", light.elevation_deg,
                           " deg above the horizon, it must be in (0, 90]");
    const double azimuth = glm::radians(light.azimuth_deg);
    const double elevation = glm::radians(light.elevation_deg);
    return {static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
            static_cast<float>(std::sin(elevation)),
            static_cast<float>(std::cos(elevation) * std::cos(azimuth))};
}

TerrainCamera camera_over(const Heightfield& field, double azimuth_deg, double elevation_deg,
                          double aspect, const CellWindow& window) {
    check_heightfield(field);
    const CellWindow all{0, 0, field.heights.width(), field.heights.height()};
    const CellWindow shown = window.empty() ? all : intersection(all, window);
    if (shown.empty() || !(aspect > 0.0))
        fail<InvalidInput>("a camera over ", shown.width, " x ", shown.height, " cells");
    float low = field.heights(shown.x, shown.y);
    float high = low;
    for (int y = shown.y; y < shown.y + shown.height; ++y)
        for (int x = shown.x; x < shown.x + shown.width; ++x) {
            low = std::min(low, field.heights(x, y));
            high = std::max(high, field.heights(x, y));
        }
    const auto cell = static_cast<float>(field.cell_size);
    const ViewBox box{{static_cast<float>(shown.x) * cell, low, static_cast<float>(shown.y) * cell},
                      {static_cast<float>(shown.x + shown.width) * cell, high,
                       static_cast<float>(shown.y + shown.height) * cell}};
    TerrainCamera camera;
    TerrainLight direction{azimuth_deg, std::clamp(elevation_deg, 5.0, 90.0)};
    const glm::vec3 back = sun_direction(direction);
    const glm::vec3 right = glm::normalize(glm::cross(upright(back), back));
    const glm::vec3 up = glm::cross(back, right);
    const glm::vec3 centre = 0.5F * (box.low + box.high);
    // Of both sides of the picture, how far back each pushes the eye; the target moves so that
    // they agree.
    const float tall =
        static_cast<float>(std::tan(glm::radians(camera.field_of_view_deg / 2.0))) / 1.08F;
    const float wide = tall * static_cast<float>(aspect);
    glm::vec4 needs(-1e30F);
    for (const glm::vec3& corner : corners_of(box)) {
        const glm::vec3 p = corner - centre;
        const float b = glm::dot(p, back);
        needs =
            glm::max(needs, glm::vec4(glm::dot(p, right) / wide + b, -glm::dot(p, right) / wide + b,
                                      glm::dot(p, up) / tall + b, -glm::dot(p, up) / tall + b));
    }
    camera.target = centre + right * (0.5F * (needs.x - needs.y) * wide) +
                    up * (0.5F * (needs.z - needs.w) * tall);
    camera.eye = camera.target + back * (0.5F * std::max(needs.x + needs.y, needs.z + needs.w));
    return camera;
}

}  // namespace scree::terrain
