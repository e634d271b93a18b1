#pragma once

#include "vision/edge_field.h"
#include "vision/outline.h"

#include <array>

namespace scree::vision {

inline constexpr int kOutlineFeatures = 14;

/// What an outline's score is estimated from once it is drawn: how well the boundary channel
/// supports it all around, how even it is, and whether inside and distance agree with it.
/// @pre All channels are filled.
std::array<float, kOutlineFeatures> outline_features(const Outline& outline,
                                                     const EdgeField& field);

}  // namespace scree::vision
