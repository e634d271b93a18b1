#pragma once

#include "vision/classical/merge_tree.h"

#include <array>

namespace scree::vision {

inline constexpr int kRegionFeatures = 42;

/// What the score of a region is estimated from. Sizes enter only as logarithms; brightness only
/// as contrast.
/// @pre 0 <= index < tree.nodes.size()
std::array<float, kRegionFeatures> region_features(const MergeTree& tree, int index);

}  // namespace scree::vision
