#include "terrain/view/tessellation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace scree::terrain {
namespace {

// exp(-t) for t >= 0 from sums, products and a shift of the exponent alone, all of which the
// shading language rounds as the processor does; its own exp() may differ from device to device.
float gaussian_tail(float t) {
    const float y = t * 1.44269504F;  // 2^-y
    if (!(y < 126.0F))
        return 0.0F;
    const float whole = std::floor(y);
    const float f = y - whole;
    float p = 0.000109328924F;
    p = p * f - 0.00127554014F;
    p = p * f + 0.00957985997F;
    p = p * f - 0.0554909321F;
    p = p * f + 0.240224331F;
    p = p * f - 0.693147045F;
    p = p * f + 1.0F;
    const auto exponent = static_cast<std::uint32_t>(127 - static_cast<int>(whole)) << 23U;
    return p * std::bit_cast<float>(exponent);
}

// A sum that is the same for every order of its terms.
float even_sum(float a, float b, float c) {
    const float low = std::min(a, std::min(b, c));
    const float high = std::max(a, std::max(b, c));
    const float middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
    return (low + high) + middle;
}

constexpr std::string_view kGlsl = R"glsl(
float gaussian_tail(float t) {
    precise float y = t * 1.44269504;
    if (!(y < 126.0))
        return 0.0;
    precise float whole = floor(y);
    precise float f = y - whole;
    precise float p = 0.000109328924;
    p = p * f - 0.00127554014;
    p = p * f + 0.00957985997;
    p = p * f - 0.0554909321;
    p = p * f + 0.240224331;
    p = p * f - 0.693147045;
    p = p * f + 1.0;
    precise float scaled = p * uintBitsToFloat(uint(127 - int(whole)) << 23);
    return scaled;
}

vec3 even_sum(vec3 a, vec3 b, vec3 c) {
    vec3 low = min(a, min(b, c));
    vec3 high = max(a, max(b, c));
    vec3 middle = max(min(a, b), min(max(a, b), c));
    precise vec3 sum = (low + high) + middle;
    return sum;
}

float tessellation_weight(vec3 a, vec3 b, vec3 c, vec3 reference, float per_radius2) {
    precise vec3 d = even_sum(a, b, c) * 0.333333343 - reference;
    precise float d2 = (d.x * d.x + d.y * d.y) + d.z * d.z;
    precise float t = d2 * per_radius2;
    return gaussian_tail(t);
}

vec4 patch_factors(vec3 p[6], vec3 reference, float per_radius2, float amount) {
    float own = tessellation_weight(p[0], p[1], p[2], reference, per_radius2);
    vec3 beyond = vec3(tessellation_weight(p[1], p[2], p[3], reference, per_radius2),
                       tessellation_weight(p[0], p[2], p[5], reference, per_radius2),
                       tessellation_weight(p[0], p[1], p[4], reference, per_radius2));
    precise vec4 factors = vec4(min(vec3(own), beyond), own) * amount + 1.0;
    return clamp(factors, 1.0, 64.0);
}
)glsl";

}  // namespace

float per_radius2(const TessellationRule& rule) {
    return 1.0F / (rule.radius * rule.radius);
}

float tessellation_weight(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                          const TessellationRule& rule) {
    const float dx = even_sum(a.x, b.x, c.x) * 0.333333343F - rule.reference.x;
    const float dy = even_sum(a.y, b.y, c.y) * 0.333333343F - rule.reference.y;
    const float dz = even_sum(a.z, b.z, c.z) * 0.333333343F - rule.reference.z;
    const float d2 = (dx * dx + dy * dy) + dz * dz;
    return gaussian_tail(d2 * per_radius2(rule));
}

PatchFactors patch_factors(const std::array<glm::vec3, 6>& p, const TessellationRule& rule) {
    const float own = tessellation_weight(p[0], p[1], p[2], rule);
    const std::array<float, 3> beyond{tessellation_weight(p[1], p[2], p[3], rule),
                                      tessellation_weight(p[0], p[2], p[5], rule),
                                      tessellation_weight(p[0], p[1], p[4], rule)};
    PatchFactors factors;
    for (std::size_t e = 0; e < 3; ++e)
        factors.edge[e] = std::clamp(std::min(own, beyond[e]) * rule.amount + 1.0F, 1.0F, 64.0F);
    factors.inside = std::clamp(own * rule.amount + 1.0F, 1.0F, 64.0F);
    return factors;
}

std::string_view tessellation_glsl() {
    return kGlsl;
}

}  // namespace scree::terrain
