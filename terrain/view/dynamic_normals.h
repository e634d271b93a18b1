#pragma once

#include "base/raster.h"

#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::terrain {

/// Slope of a displacement above which its own normals have their full share (C.12).
inline constexpr float kDynamicNormalSlope = 0.1F;

/// Slopes along x and z by central differences, one-sided at the rim; no unit.
/// @param cell_size  Edge of a cell, metres.
glm::vec2 slopes_at(const FloatRaster& heights, int x, int y, float cell_size);

/// Normal of a surface with these slopes: normalize(-dx, 1, -dz).
glm::vec3 normal_of(const glm::vec2& slopes);

/// Share of the dynamic normal, from the slopes of the displacement alone: half of
/// clamp(|grad u| / g0, 0, 1).
float dynamic_share(const glm::vec2& displacement_slopes);

/// normalize((1 - share) * mapped + share * dynamic), `rocks-and-deformer.md` C.12.
glm::vec3 blend_normals(const glm::vec3& mapped, const glm::vec3& dynamic, float share);

/// The last three in GLSL, under the same names.
std::string_view dynamic_normals_glsl();

}  // namespace scree::terrain
