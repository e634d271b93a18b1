#include "meshing/rocks/world_frame.h"

#include "base/error.h"

#include <cmath>

#include <glm/vec4.hpp>

namespace scree::meshing {
namespace {

constexpr double kGreatestScale = 1e6;
constexpr double kLeastScale = 1e-9;

void check_picture(int width_px, int height_px) {
    if (width_px <= 0 || height_px <= 0)
        fail<InvalidInput>("the photograph is ", width_px, " x ", height_px,
                           " pixels, both sides must be positive");
}

}  // namespace

GroundRegion region_of(const vision::RockSet& set) {
    check_picture(set.width, set.height);
    const double scale = vision::scale_of(set);
    if (!(scale >= kLeastScale && scale <= kGreatestScale))
        fail<InvalidInput>("the scale is ", scale, " metres a pixel, must be in [", kLeastScale,
                           ", ", kGreatestScale, "]");
    return {set.width * scale, set.height * scale, {}};
}

glm::dmat4 world_from_image(int width_px, int height_px, const GroundRegion& region) {
    check_picture(width_px, height_px);
    const bool positive = region.width > 0.0 && region.depth > 0.0;
    if (!positive || !std::isfinite(region.width) || !std::isfinite(region.depth))
        fail<InvalidInput>("the ground region is ", region.width, " x ", region.depth,
                           " m, both sides must be positive");
    glm::dmat4 w(1.0);  // columns first: w[column][row]
    w[0][0] = region.width / width_px;
    w[1][1] = std::hypot(region.width, region.depth) / std::hypot(width_px, height_px);
    w[2][2] = region.depth / height_px;
    w[3] = glm::dvec4(region.translation, 1.0);
    return w;
}

glm::dvec3 to_world(const glm::dmat4& world_from_image, int width_px, int height_px,
                    const glm::dvec3& image_point) {
    const glm::dvec4 centred(image_point.x - 0.5 * width_px, image_point.y,
                             image_point.z - 0.5 * height_px, 1.0);
    return glm::dvec3(world_from_image * centred);
}

}  // namespace scree::meshing
