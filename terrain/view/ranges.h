#pragma once

#include <string_view>

namespace scree::terrain {

/// How ground is shown at a distance (`rocks-and-deformer.md` C.12).
enum class ViewRange {
    Near,    ///< d < r1: gravel as rock meshes, other soil displaced and tessellated.
    Middle,  ///< r1 <= d <= r2: all displaced and tessellated.
    Far,     ///< d > r2: normals alone.
};

/// Radii round the camera, metres.
struct ViewRanges {
    float near_m = 1.0F;  ///< r1
    float far_m = 10.0F;  ///< r2
};

/// Share of a radius, before it, over which one way of showing gives place to the next.
inline constexpr float kRangeBand = 0.25F;

ViewRange range_at(float distance, const ViewRanges& ranges);

/// How far rock meshes stand in for their picture: 1 near, smoothly 0 at r1 and beyond.
float mesh_share(float distance, const ViewRanges& ranges);

/// How far displacement moves the mesh: 1 up to the middle, smoothly 0 at r2 and beyond.
float displacement_share(float distance, const ViewRanges& ranges);

/// `float range_share(float distance, float radius)`: 1 before the band, 0 from the radius on.
std::string_view ranges_glsl();

}  // namespace scree::terrain
