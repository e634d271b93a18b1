#include "vision/classical/region_index.h"

namespace scree::vision {

RegionIndex::RegionIndex(const RegionHierarchy& hierarchy)
    : order_(hierarchy.basins.labels), runs_(hierarchy.tree.nodes.size()) {
    const auto& nodes = hierarchy.tree.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)  // count the basins of each first
        runs_[i].last = nodes[i].left < 0
                            ? 1
                            : runs_[static_cast<std::size_t>(nodes[i].left)].last +
                                  runs_[static_cast<std::size_t>(nodes[i].right)].last;
    std::int32_t free = 0;
    for (std::size_t i = nodes.size(); i-- > 0;) {
        if (nodes[i].parent < 0) {
            runs_[i] = {free, free + runs_[i].last};
            free = runs_[i].last;
        }
        if (nodes[i].left < 0)
            continue;
        Run& left = runs_[static_cast<std::size_t>(nodes[i].left)];
        Run& right = runs_[static_cast<std::size_t>(nodes[i].right)];
        left = {runs_[i].first, runs_[i].first + left.last};
        right = {left.last, left.last + right.last};
    }
    for (auto& label : order_)
        if (label != kNoBasin)
            label = runs_[static_cast<std::size_t>(label)].first;
}

}  // namespace scree::vision
