#include "meshing/render/view_light.h"

#include "base/parallel.h"
#include "meshing/render/rasteriser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace scree::meshing {
namespace {

constexpr int kShadowSide = 1536;
constexpr int kHeightSide = 640;
constexpr std::size_t kPiece = 8192;

// Means over squares of 2 r + 1 pixels by running sums, the rim repeated: first along rows.
FloatRaster blurred_rows(const FloatRaster& values, int radius) {
    FloatRaster out(values.width(), values.height());
    const float share = 1.0F / static_cast<float>(2 * radius + 1);
    const int last = values.width() - 1;
    parallel_for_each_index(0, static_cast<std::size_t>(values.height()), 16, [&](std::size_t row) {
        const float* in = values.row(static_cast<int>(row));
        double sum = 0.0;
        for (int x = -radius; x <= radius; ++x)
            sum += in[std::clamp(x, 0, last)];
        for (int x = 0; x <= last; ++x) {
            out(x, static_cast<int>(row)) = static_cast<float>(sum) * share;
            sum += in[std::min(x + radius + 1, last)] - in[std::max(x - radius, 0)];
        }
    });
    return out;
}

FloatRaster transposed(const FloatRaster& values) {
    FloatRaster out(values.height(), values.width());
    parallel_for_each_index(0, static_cast<std::size_t>(values.width()), 32, [&](std::size_t x) {
        for (int y = 0; y < values.height(); ++y)
            out(y, static_cast<int>(x)) = values(static_cast<int>(x), y);
    });
    return out;
}

FloatRaster blurred(const FloatRaster& values, int radius) {
    // Twice a box is a tent: no square patterns around single objects.
    const FloatRaster rows = blurred_rows(blurred_rows(values, radius), radius);
    const FloatRaster turned = transposed(rows);
    return transposed(blurred_rows(blurred_rows(turned, radius), radius));
}

float bilinear(const FloatRaster& values, float x, float y) {
    const float u = std::clamp(x - 0.5F, 0.0F, static_cast<float>(values.width() - 1));
    const float v = std::clamp(y - 0.5F, 0.0F, static_cast<float>(values.height() - 1));
    const int left = static_cast<int>(u);
    const int top = static_cast<int>(v);
    const int right = std::min(left + 1, values.width() - 1);
    const int bottom = std::min(top + 1, values.height() - 1);
    const float fx = u - static_cast<float>(left);
    const float fy = v - static_cast<float>(top);
    const float above = values(left, top) * (1 - fx) + values(right, top) * fx;
    const float below = values(left, bottom) * (1 - fx) + values(right, bottom) * fx;
    return above * (1 - fy) + below * fy;
}

glm::mat3 axes_towards(const glm::vec3& eye) {
    const glm::vec3 other = std::abs(eye.y) < 0.99F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    const glm::vec3 right = glm::normalize(glm::cross(other, eye));
    return {right, glm::cross(eye, right), eye};
}

}  // namespace

DepthMap::DepthMap(const ViewGeometry& scene, const glm::mat3& axes, int side)
    : map_from_world_(glm::transpose(axes)) {
    std::vector<glm::vec3> screen(scene.positions.size());
    parallel_for(0, screen.size(), kPiece, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            screen[i] = map_from_world_ * scene.positions[i];
    });
    glm::vec2 low(std::numeric_limits<float>::max());
    glm::vec2 high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : screen) {
        low = glm::min(low, glm::vec2(p));
        high = glm::max(high, glm::vec2(p));
    }
    const glm::vec2 size = glm::max(high - low, glm::vec2(1e-12F));
    texel_ = std::max(size.x, size.y) / static_cast<float>(side - 2);
    origin_ = {low.x - texel_, high.y + texel_};
    for (glm::vec3& p : screen)
        p = {(p.x - origin_.x) / texel_, (origin_.y - p.y) / texel_, p.z};
    const auto pixels = [&](float length) {
        return std::clamp(static_cast<int>(std::ceil(length / texel_)) + 2, 3, side);
    };
    nearness_ = rasterise(screen, scene.triangles, pixels(size.x), pixels(size.y)).nearness;
}

glm::vec3 DepthMap::project(const glm::vec3& point) const {
    const glm::vec3 p = map_from_world_ * point;
    return {(p.x - origin_.x) / texel_, (origin_.y - p.y) / texel_, p.z};
}

ViewLight::ViewLight(const ViewGeometry& scene, const glm::vec3& to_light)
    : shadow_(scene, axes_towards(to_light), kShadowSide),
      height_(scene, axes_towards({0, 1, 0}), kHeightSide) {
    FloatRaster& heights = height_.nearness();
    const float empty = std::numeric_limits<float>::lowest();
    float lowest = std::numeric_limits<float>::max();
    for (const float h : heights)
        lowest = h > empty ? std::min(lowest, h) : lowest;
    for (float& h : heights)
        h = h > empty ? h : lowest;
    const float radius = std::max(scene.object_radius / height_.texel(), 2.0F);
    const int near = std::clamp(static_cast<int>(std::lround(0.25F * radius)), 1, 64);
    const int far = std::clamp(static_cast<int>(std::lround(0.75F * radius)), 2, 192);
    near_mean_ = blurred(heights, near);
    far_mean_ = blurred(heights, far);
    near_reach_ = 2.0F * static_cast<float>(near) * height_.texel();
    far_reach_ = 2.0F * static_cast<float>(far) * height_.texel();
}

float ViewLight::lit(const glm::vec3& point, const glm::vec3& normal) const {
    // Moved off the surface by a pixel and a half, or it would shade itself.
    const glm::vec3 p = shadow_.project(point + normal * (1.5F * shadow_.texel()));
    const FloatRaster& map = shadow_.nearness();
    const int left = static_cast<int>(std::floor(p.x - 0.5F));
    const int top = static_cast<int>(std::floor(p.y - 0.5F));
    const float fx = p.x - 0.5F - static_cast<float>(left);
    const float fy = p.y - 0.5F - static_cast<float>(top);
    const auto open = [&](int x, int y) {
        return !map.contains(x, y) || map(x, y) <= p.z + 0.75F * shadow_.texel() ? 1.0F : 0.0F;
    };
    const float above = open(left, top) * (1 - fx) + open(left + 1, top) * fx;
    const float below = open(left, top + 1) * (1 - fx) + open(left + 1, top + 1) * fx;
    return above * (1 - fy) + below * fy;
}

float ViewLight::open_sky(const glm::vec3& point) const {
    const glm::vec3 p = height_.project(point);
    const float near = (bilinear(near_mean_, p.x, p.y) - p.z) / near_reach_;
    const float far = (bilinear(far_mean_, p.x, p.y) - p.z) / far_reach_;
    return (1.0F - std::clamp(1.6F * near, 0.0F, 0.6F)) *
           (1.0F - std::clamp(1.4F * far, 0.0F, 0.6F));
}

}  // namespace scree::meshing
