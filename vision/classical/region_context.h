#pragma once

#include "vision/classical/merge_tree.h"

#include <array>
#include <span>
#include <vector>

namespace scree::vision {

/// What is expected of a candidate, learned from labelled photographs.
struct RegionScore {
    float match = 0;    ///< Chance that it overlaps a whole rock by more than a half.
    float overlap = 0;  ///< Expected overlap (intersection over union) with the best rock.
};

inline constexpr int kContextFeatures = 7;
using ContextFeatures = std::array<float, kContextFeatures>;

/// How every region stands among its fragments and the regions that it is a part of, by a first
/// score: its own match and overlap, the worth of the best choice among its fragments, the most
/// that a region around it gains over that one's fragments, the match of its parent and of its
/// sibling, and the best match within.
///
/// @pre   One finite score a node.
/// @throw InvalidInput  the counts differ.
std::vector<ContextFeatures> region_contexts(const MergeTree& tree,
                                             std::span<const RegionScore> first);

}  // namespace scree::vision
