#include "vision/classical/region_context.h"

#include "base/error.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

// Three basins: 0 and 1 become 3, 3 and 2 become 4.
MergeTree small_tree() {
    MergeTree tree;
    tree.n_basins = 3;
    tree.nodes.resize(5);
    const auto unite = [&](std::size_t whole, int a, int b) {
        tree.nodes[whole].left = a;
        tree.nodes[whole].right = b;
        for (const int part : {a, b})
            tree.nodes[static_cast<std::size_t>(part)].parent = static_cast<int>(whole);
    };
    unite(3, 0, 1);
    unite(4, 3, 2);
    return tree;
}

TEST(RegionContext, WeighsRegionsAgainstFragmentsAndWholes) {
    // A region of match and overlap m is worth m - 0.38.
    const std::vector<RegionScore> first = {
        {0.48F, 0.48F}, {0.58F, 0.58F}, {0.3F, 0.3F}, {0.88F, 0.88F}, {0.1F, 0.1F}};
    const auto contexts = region_contexts(small_tree(), first);
    ASSERT_EQ(contexts.size(), 5U);
    const auto expect = [&](std::size_t region, const ContextFeatures& wanted) {
        for (std::size_t k = 0; k < wanted.size(); ++k)
            EXPECT_NEAR(contexts[region][k], wanted[k], 1e-6) << region << ' ' << k;
    };
    // own match, own overlap, fragments, gain around, parent, sibling, best match within
    expect(0, {0.48F, 0.48F, 0.0F, 0.2F, 0.88F, 0.58F, 0.0F});
    expect(1, {0.58F, 0.58F, 0.0F, 0.2F, 0.88F, 0.48F, 0.0F});
    expect(2, {0.3F, 0.3F, 0.0F, 0.0F, 0.1F, 0.88F, 0.0F});
    expect(3, {0.88F, 0.88F, 0.3F, 0.0F, 0.1F, 0.3F, 0.58F});
    expect(4, {0.1F, 0.1F, 0.5F, 0.0F, 0.0F, 0.0F, 0.88F});
}

TEST(RegionContext, NeedsAScoreForEveryRegion) {
    EXPECT_THAT(
        [] { region_contexts(small_tree(), std::vector<RegionScore>(4)); },
        testing::ThrowsMessage<InvalidInput>("the tree has 5 regions but 4 scores are given"));
}

}  // namespace
}  // namespace scree::vision
