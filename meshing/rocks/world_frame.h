#pragma once

#include "vision/rock_data.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// The rectangle of ground that a photograph shows, in the plane y = 0, metres.
struct GroundRegion {
    double width = 0.0;           ///< Along x; positive.
    double depth = 0.0;           ///< Along z; positive.
    glm::dvec3 translation{0.0};  ///< From the world's origin to the region's centre.
};

/// Ground that the photograph of a rock set covers at its scale, centred on the origin.
/// @throw InvalidInput  the picture has no size or the scale is not a number in (0, 1e6].
GroundRegion region_of(const vision::RockSet& set);

/// Metres from pixels centred on the picture (`rocks-and-deformer.md` eq. 3.9): x and z scale with
/// the sides, y with the diagonals.
/// @throw InvalidInput  a side of the picture or the region is not positive and finite.
glm::dmat4 world_from_image(int width_px, int height_px, const GroundRegion& region);

/// World position of the picture point (column, row) with height y, all in pixels (eq. 3.10).
glm::dvec3 to_world(const glm::dmat4& world_from_image, int width_px, int height_px,
                    const glm::dvec3& image_point);

}  // namespace scree::meshing
