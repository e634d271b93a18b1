#include "vision/classical/region_context.h"

#include "base/error.h"

#include <algorithm>

namespace scree::vision {
namespace {

// Worth at which a candidate begins to be called a rock; training/train_score.py has the same.
constexpr float kCaution = 0.38F;

struct Standing {
    float worth = 0;      // of the region itself
    float fragments = 0;  // of the best choice among its fragments
    float best = 0;       // the greater of the two
    float within = 0;     // best match of a fragment
    float around = 0;     // most that a region around it gains over its own fragments
};

}  // namespace

std::vector<ContextFeatures> region_contexts(const MergeTree& tree,
                                             std::span<const RegionScore> first) {
    const std::size_t n = tree.nodes.size();
    if (first.size() != n)
        fail<InvalidInput>("the tree has ", n, " regions but ", first.size(), " scores are given");
    std::vector<Standing> standing(n);
    for (std::size_t i = 0; i < n; ++i) {  // fragments come before their union
        Standing& s = standing[i];
        s.worth = std::max(0.0F, 0.5F * (first[i].match + first[i].overlap) - kCaution);
        if (tree.nodes[i].left >= 0)
            for (const int part : {tree.nodes[i].left, tree.nodes[i].right}) {
                const auto p = static_cast<std::size_t>(part);
                s.fragments += standing[p].best;
                s.within = std::max({s.within, standing[p].within, first[p].match});
            }
        s.best = std::max(s.worth, s.fragments);
    }
    std::vector<ContextFeatures> contexts(n);
    for (std::size_t i = n; i-- > 0;) {
        Standing& s = standing[i];
        float parent = 0, sibling = 0;
        if (tree.nodes[i].parent >= 0) {
            const auto p = static_cast<std::size_t>(tree.nodes[i].parent);
            const RegionNode& whole = tree.nodes[p];
            const int other = whole.left == static_cast<int>(i) ? whole.right : whole.left;
            s.around = std::max(standing[p].around, standing[p].worth - standing[p].fragments);
            parent = first[p].match;
            sibling = first[static_cast<std::size_t>(other)].match;
        }
        contexts[i] = {first[i].match, first[i].overlap, s.fragments, s.around,
                       parent,         sibling,          s.within};
    }
    return contexts;
}

}  // namespace scree::vision
