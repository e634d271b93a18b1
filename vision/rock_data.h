#pragma once

#include "vision/outline.h"

#include <optional>
#include <string>
#include <vector>

namespace scree::vision {

/// Metres a pixel stands for where nobody said: a picture 1,000 pixels wide shows one metre.
inline constexpr double kAssumedMetresPerPixel = 0.001;

/// One rock of a photograph (`rocks-and-deformer.md` A.12), in pixels.
struct Rock {
    Outline outline;
    float depth =
        0.0F;  ///< Semi-axis across the picture plane, px; the source takes the least radius.
    float uncertainty =
        0.0F;  ///< One standard deviation of the outline's radius, px; 0 if not estimated.
};

/// All rocks of one photograph, ordered by decreasing confidence.
struct RockSet {
    std::string image;              ///< File name of the photograph, without its folder.
    int width = 0;                  ///< Of the photograph, px.
    int height = 0;                 ///< Of the photograph, px.
    double metres_per_pixel = 0.0;  ///< 0 if unknown.
    std::string method;             ///< Words of the method that found them.
    std::vector<Rock> rocks;
    /// To gravel, 0 to 1 (gravel_likeness.h); empty if unknown.
    std::optional<double> likeness = std::nullopt;
};

/// The scale to build with: the known one, else kAssumedMetresPerPixel.
inline double scale_of(const RockSet& set) {
    return set.metres_per_pixel > 0.0 ? set.metres_per_pixel : kAssumedMetresPerPixel;
}

}  // namespace scree::vision
