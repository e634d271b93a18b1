#pragma once

#include "base/raster.h"

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace scree::meshing {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFU;

/// What is seen through every pixel's centre.
struct Visibility {
    FloatRaster nearness;            ///< Of the nearest triangle; lowest() where there is none.
    Raster<std::uint32_t> triangle;  ///< Its index; kNoTriangle where there is none.
};

/// Find the nearest triangle behind every pixel of a picture.
///
/// `screen` holds pixels right (x) and down (y) and a nearness (z) that grows towards the eye and
/// is linear across the screen: the reciprocal of the distance along the view axis under
/// perspective, minus the depth in a parallel projection. Triangles that run clockwise on the
/// screen (y down), are thinner than 1/16 pixel or reach beyond 2^20 pixels are left out.
/// Neighbours that share an edge leave no gap between them. Of equally near triangles the one
/// listed first is seen, so the result is the same for any number of threads.
///
/// @pre   Every index is within `screen`.
/// @throw InvalidInput  the width or height is not in [1, 16384].
Visibility rasterise(std::span<const glm::vec3> screen, std::span<const glm::uvec3> triangles,
                     int width, int height);

}  // namespace scree::meshing
