#include "vision/classical/region_index.h"

#include <algorithm>

namespace scree::vision {
namespace {

RegionIndex::Box around(const RegionIndex::Box& a, const RegionIndex::Box& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

std::vector<RegionIndex::Box> boxes_of(const RegionHierarchy& hierarchy) {
    const auto& nodes = hierarchy.tree.nodes;
    const auto& labels = hierarchy.basins.labels;
    std::vector<RegionIndex::Box> boxes(nodes.size());
    for (int y = 0; y < labels.height(); ++y)
        for (int x = 0; x < labels.width(); ++x)
            if (labels(x, y) != kNoBasin) {
                auto& box = boxes[static_cast<std::size_t>(labels(x, y))];
                box = around(box, {x, y, x + 1, y + 1});
            }
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].left >= 0)
            boxes[i] = around(boxes[static_cast<std::size_t>(nodes[i].left)],
                              boxes[static_cast<std::size_t>(nodes[i].right)]);
    return boxes;
}

}  // namespace

RegionIndex::RegionIndex(const RegionHierarchy& hierarchy)
    : order_(hierarchy.basins.labels),
      runs_(hierarchy.tree.nodes.size()),
      boxes_(boxes_of(hierarchy)) {
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
