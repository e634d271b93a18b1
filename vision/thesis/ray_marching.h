#pragma once

#include "base/raster.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

/// Where a ray first meets an edge.
struct RayHit {
    glm::ivec2 pixel{0};    ///< The edge pixel.
    double distance = 0.0;  ///< From the origin to where the ray enters it, px.
};

/// Unit vectors at azimuths 2 pi l / n, l = 0 .. n - 1, from +x towards +y.
std::vector<glm::dvec2> ray_directions(int n_rays);

/// Casts rays over an edge mask.
///
/// Rays visit every pixel they cross, so none slips between two edge pixels that touch only by a
/// corner. A distance map lets them leap over empty ground without missing a pixel.
class RayCaster {
public:
    explicit RayCaster(const Mask& edges);

    int width() const { return reach_.width(); }
    int height() const { return reach_.height(); }

    /// The point lies in the picture and on no edge pixel.
    bool is_open(glm::dvec2 point) const;

    /// Chessboard distance of a pixel to the nearest edge pixel, at most 255.
    int clearance(int x, int y) const { return reach_(x, y); }

    /// First edge pixel on the ray, or nothing if it leaves the picture.
    /// @pre  `direction` is a unit vector, the origin lies in the picture.
    std::optional<RayHit> cast(glm::dvec2 origin, glm::dvec2 direction) const;

private:
    Raster<std::uint8_t> reach_;
};

}  // namespace scree::vision
