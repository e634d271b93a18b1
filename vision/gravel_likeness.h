#pragma once

#include "vision/rock_data.h"

#include <string>
#include <vector>

namespace scree::vision {

/// From here on a picture counts as gravel; below, whoever shows the rocks should warn.
inline constexpr double kLooksLikeGravel = 0.5;

/// How much the rocks that were found look like those of a photograph of gravel.
struct GravelLikeness {
    double likeness = 0.0;    ///< 0 to 1: the least of five shares, one a figure below.
    std::size_t n_rocks = 0;  ///< Gravel is many rocks: 0 to 30 of them count as 0 to 1.
    double confidence = 0.0;  ///< Their mean confidence.
    double explained = 0.0;   ///< Share of the field's boundary that lies on their outlines.
    double spread = 0.0;      ///< Standard deviation of the logarithm of their diameters.
    double alignment = 0.0;   ///< 0: their long axes point anywhere; 1: all the same way.
    std::string reason;  ///< What makes it no gravel, in words; empty from kLooksLikeGravel on.
};

/// Look at the rocks and the field they came from, never at the photograph.
///
/// docs/gravel-likeness.md has the shares and what they were measured on.
/// @param boundary  Of the edge field.
/// @pre   Outlines have finite centres and positive radii.
/// @throw InvalidInput  the boundary is empty.
GravelLikeness gravel_likeness(const FloatRaster& boundary, const std::vector<Rock>& rocks);

}  // namespace scree::vision
