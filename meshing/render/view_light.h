#pragma once

#include "base/raster.h"

#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// A scene flattened into one list of triangles in world space.
struct ViewGeometry {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles;
    float object_radius = 0.0F;  ///< Typical half width of an object, metres; 0 if there is none.
};

/// Depths of a scene seen along one direction in parallel projection.
class DepthMap {
public:
    /// @param axes  Columns: right, up and towards the eye, orthonormal.
    /// @param side  Pixels along the longer side.
    DepthMap(const ViewGeometry& scene, const glm::mat3& axes, int side);

    float texel() const { return texel_; }  ///< Edge of a pixel, metres.
    FloatRaster& nearness() { return nearness_; }
    const FloatRaster& nearness() const { return nearness_; }

    /// Pixel coordinates (x, y) and nearness (z) of a point in the world.
    glm::vec3 project(const glm::vec3& point) const;

private:
    glm::mat3 map_from_world_{1.0F};
    glm::vec2 origin_{0.0F};
    float texel_ = 1.0F;
    FloatRaster nearness_;
};

/// Shadows of the key light and openness to the sky.
class ViewLight {
public:
    /// @param to_light  Unit vector towards the key light.
    ViewLight(const ViewGeometry& scene, const glm::vec3& to_light);

    /// Share of the key light that reaches a point of a surface with this normal, 0 to 1.
    float lit(const glm::vec3& point, const glm::vec3& normal) const;

    /// Share of the sky seen from a point, 0 to 1: what lies above it in two neighbourhoods.
    float open_sky(const glm::vec3& point) const;

private:
    DepthMap shadow_;
    DepthMap height_;
    FloatRaster near_mean_;  ///< Mean height within half an object's radius.
    FloatRaster far_mean_;   ///< Mean height within one and a half of it.
    float near_reach_ = 1.0F;
    float far_reach_ = 1.0F;
};

}  // namespace scree::meshing
