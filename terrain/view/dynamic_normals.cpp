#include "terrain/view/dynamic_normals.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

namespace scree::terrain {

glm::vec2 slopes_at(const FloatRaster& heights, int x, int y, float cell_size) {
    assert(heights.contains(x, y));
    const int left = std::max(x - 1, 0);
    const int right = std::min(x + 1, heights.width() - 1);
    const int back = std::max(y - 1, 0);
    const int front = std::min(y + 1, heights.height() - 1);
    glm::vec2 slopes(0.0F);
    if (right > left)
        slopes.x =
            (heights(right, y) - heights(left, y)) / (static_cast<float>(right - left) * cell_size);
    if (front > back)
        slopes.y =
            (heights(x, front) - heights(x, back)) / (static_cast<float>(front - back) * cell_size);
    return slopes;
}

glm::vec3 normal_of(const glm::vec2& slopes) {
    return glm::normalize(glm::vec3(-slopes.x, 1.0F, -slopes.y));
}

float dynamic_share(const glm::vec2& displacement_slopes) {
    return 0.5F * std::clamp(glm::length(displacement_slopes) / kDynamicNormalSlope, 0.0F, 1.0F);
}

glm::vec3 blend_normals(const glm::vec3& mapped, const glm::vec3& dynamic, float share) {
    return glm::normalize((1.0F - share) * mapped + share * dynamic);
}

std::string_view dynamic_normals_glsl() {
    return R"glsl(
vec3 normal_of(vec2 slopes) { return normalize(vec3(-slopes.x, 1.0, -slopes.y)); }

float dynamic_share(vec2 displacement_slopes) {
    return 0.5 * clamp(length(displacement_slopes) / 0.1, 0.0, 1.0);
}

vec3 blend_normals(vec3 mapped, vec3 dynamic, float share) {
    return normalize((1.0 - share) * mapped + share * dynamic);
}
)glsl";
}

}  // namespace scree::terrain
