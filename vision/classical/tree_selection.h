#pragma once

#include "vision/classical/merge_tree.h"

#include <span>
#include <vector>

namespace scree::vision {

/// Choose regions that do not overlap so that the sum of their worths is greatest.
///
/// A region stands against the best choice among its own fragments, so one big rock is weighed
/// against the pieces in it. Exact: no other choice from the tree has a larger sum. Regions of no
/// positive worth are never taken; on a tie the larger region wins.
/// @pre   One finite worth a node.
/// @post  No chosen region lies within another; increasing order.
/// @throw InvalidInput  the counts differ.
std::vector<int> select_regions(const MergeTree& tree, std::span<const float> worth);

}  // namespace scree::vision
