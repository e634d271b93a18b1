#pragma once

#include <array>
#include <string_view>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// Where and how finely patches are cut (`rocks-and-deformer.md` eq. 4.14).
struct TessellationRule {
    glm::vec3 reference{0.0F};  ///< The camera's point or an object's place, metres.
    float radius = 1.0F;        ///< k: radius of the refined neighbourhood, metres.
    float amount = 8.0F;        ///< T: parts of an edge at the reference, less one.
};

/// Factors of a patch; edge e lies opposite corner e.
struct PatchFactors {
    std::array<float, 3> edge{1.0F, 1.0F, 1.0F};
    float inside = 1.0F;
};

/// Weight of a triangle, exp(-(d / k)^2) of the distance from the reference to the mean of its
/// corners. The order of the corners does not change a bit of it.
float tessellation_weight(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                          const TessellationRule& rule);

/// Factors of a patch with six control points, each in [1, 64]. Two patches of an edge give it the
/// same factor, bit for bit, so no cracks open.
PatchFactors patch_factors(const std::array<glm::vec3, 6>& points, const TessellationRule& rule);

/// The same arithmetic in GLSL: `float tessellation_weight(vec3 a, vec3 b, vec3 c, vec3 reference,
/// float per_radius2)` and `vec4 patch_factors(vec3 points[6], vec3 reference, float per_radius2,
/// float amount)` with the edges in xyz, the inside in w. `per_radius2` is `per_radius2(rule)`.
std::string_view tessellation_glsl();

/// 1 / k^2 in float, as both forms use it.
float per_radius2(const TessellationRule& rule);

}  // namespace scree::terrain
