#include "vision/classical/tree_selection.h"

#include "base/error.h"

namespace scree::vision {

std::vector<int> select_regions(const MergeTree& tree, std::span<const float> worth) {
    const std::size_t n = tree.nodes.size();
    if (worth.size() != n)
        fail<InvalidInput>("the tree has ", n, " regions but ", worth.size(), " worths are given");
    std::vector<double> best(n, 0.0);
    std::vector<bool> taken(n, false);
    for (std::size_t i = 0; i < n; ++i) {  // fragments come before their union
        const RegionNode& node = tree.nodes[i];
        const double fragments = node.left < 0 ? 0.0
                                               : best[static_cast<std::size_t>(node.left)] +
                                                     best[static_cast<std::size_t>(node.right)];
        taken[i] = worth[i] > 0.0F && worth[i] >= fragments;
        best[i] = taken[i] ? worth[i] : fragments;
    }
    std::vector<bool> covered(n, false);
    std::vector<int> chosen;
    for (std::size_t i = n; i-- > 0;) {
        const int parent = tree.nodes[i].parent;
        covered[i] = parent >= 0 && (covered[static_cast<std::size_t>(parent)] ||
                                     taken[static_cast<std::size_t>(parent)]);
        if (taken[i] && !covered[i])
            chosen.push_back(static_cast<int>(i));
    }
    return {chosen.rbegin(), chosen.rend()};
}

}  // namespace scree::vision
