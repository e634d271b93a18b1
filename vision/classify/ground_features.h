#pragma once

#include "vision/classify/superpixels.h"

#include <array>
#include <string_view>
#include <vector>

namespace scree::vision {

inline constexpr std::size_t kGroundFeatures = 22;

/// What each feature is, in order; docs/classification.md has the formulae.
inline constexpr std::array<std::string_view, kGroundFeatures> kGroundFeatureNames = {
    "lightness",         "red-green",          "yellow-blue",        "chroma",
    "contrast",          "detail-1px",         "detail-2px",         "detail-4px",
    "detail-8px",        "detail-16px",        "grain-size",         "skewness",
    "peakedness-fine",   "peakedness-coarse",  "strokes-short",      "strokes-long",
    "one-direction",     "red-green-spread",   "yellow-blue-spread", "dark-share",
    "detail-slope-fine", "detail-slope-coarse"};

using GroundFeatures = std::array<float, kGroundFeatures>;

/// Colour and texture of every superpixel, averaged over it; texture is measured in a soft window
/// of some 25 pixels round each pixel.
std::vector<GroundFeatures> ground_features(const Raster<glm::vec3>& lab,
                                            const Superpixels& pieces);

}  // namespace scree::vision
