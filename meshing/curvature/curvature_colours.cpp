#include "meshing/curvature/curvature_colours.h"

#include <algorithm>
#include <cmath>

namespace scree::meshing {

glm::u8vec3 curvature_colour(float scaled) {
    const float value = std::isfinite(scaled) ? std::clamp(scaled, -1.0F, 1.0F) : 0.0F;
    const auto byte = [](float share) {
        return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(share, 0.0F, 1.0F)));
    };
    return {byte(value), byte(1.0F - std::abs(value)), byte(-value)};
}

std::vector<glm::u8vec3> curvature_colours(std::span<const float> curvature, float factor) {
    std::vector<glm::u8vec3> colours(curvature.size());
    std::transform(curvature.begin(), curvature.end(), colours.begin(),
                   [factor](float h) { return curvature_colour(h * factor); });
    return colours;
}

}  // namespace scree::meshing
