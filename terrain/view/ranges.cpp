#include "terrain/view/ranges.h"

#include <algorithm>

namespace scree::terrain {
namespace {

float range_share(float distance, float radius) {
    if (!(radius > 0.0F))
        return 0.0F;
    const float begin = radius * (1.0F - kRangeBand);
    const float t = std::clamp((distance - begin) / (radius - begin), 0.0F, 1.0F);
    return 1.0F - t * t * (3.0F - 2.0F * t);
}

}  // namespace

ViewRange range_at(float distance, const ViewRanges& ranges) {
    if (distance < ranges.near_m)
        return ViewRange::Near;
    return distance <= ranges.far_m ? ViewRange::Middle : ViewRange::Far;
}

float mesh_share(float distance, const ViewRanges& ranges) {
    return range_share(distance, ranges.near_m);
}

float displacement_share(float distance, const ViewRanges& ranges) {
    return range_share(distance, ranges.far_m);
}

std::string_view ranges_glsl() {
    return R"glsl(
float range_share(float distance, float radius) {
    if (!(radius > 0.0))
        return 0.0;
    return 1.0 - smoothstep(radius * 0.75, radius, distance);
}
)glsl";
}

}  // namespace scree::terrain
