#include "vision/classical/tree_selection.h"

#include "base/error.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

// A tree over `n` leaves whose shape and worths follow from the seed.
struct Case {
    MergeTree tree;
    std::vector<float> worth;
};

Case made_up(int n, unsigned seed) {
    Case c;
    c.tree.n_basins = n;
    c.tree.nodes.resize(static_cast<std::size_t>(n));
    std::vector<int> roots;
    for (int i = 0; i < n; ++i)
        roots.push_back(i);
    unsigned state = seed * 2654435761U + 12345U;
    const auto next = [&] { return (state = state * 1664525U + 1013904223U) >> 8U; };
    while (roots.size() > 1 + seed % 2) {
        const std::size_t a = next() % roots.size();
        const int left = roots[a];
        roots.erase(roots.begin() + static_cast<std::ptrdiff_t>(a));
        const std::size_t b = next() % roots.size();
        const int whole = static_cast<int>(c.tree.nodes.size());
        c.tree.nodes.push_back({});
        c.tree.nodes.back().left = left;
        c.tree.nodes.back().right = roots[b];
        for (const int part : {left, roots[b]})
            c.tree.nodes[static_cast<std::size_t>(part)].parent = whole;
        roots[b] = whole;
    }
    for (std::size_t i = 0; i < c.tree.nodes.size(); ++i)
        c.worth.push_back(static_cast<float>(next() % 200) / 100.0F - 0.6F);
    return c;
}

bool overlap(const MergeTree& tree, int a, int b) {
    for (int at = a; at >= 0; at = tree.nodes[static_cast<std::size_t>(at)].parent)
        if (at == b)
            return true;
    for (int at = b; at >= 0; at = tree.nodes[static_cast<std::size_t>(at)].parent)
        if (at == a)
            return true;
    return false;
}

double best_by_trying_all(const Case& c) {
    const auto n = static_cast<int>(c.worth.size());
    double best = 0;
    for (unsigned chosen = 0; chosen < 1U << static_cast<unsigned>(n); ++chosen) {
        double sum = 0;
        bool valid = true;
        for (int i = 0; i < n && valid; ++i) {
            if ((chosen >> static_cast<unsigned>(i) & 1U) == 0)
                continue;
            sum += c.worth[static_cast<std::size_t>(i)];
            for (int j = 0; j < i && valid; ++j)
                valid = (chosen >> static_cast<unsigned>(j) & 1U) == 0 || !overlap(c.tree, i, j);
        }
        if (valid)
            best = std::max(best, sum);
    }
    return best;
}

class Selection : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(Selection, EqualsTryingAllChoices) {
    const Case c = made_up(2 + static_cast<int>(GetParam() % 6), GetParam());
    const auto chosen = select_regions(c.tree, c.worth);
    double sum = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        sum += c.worth[static_cast<std::size_t>(chosen[i])];
        EXPECT_GT(c.worth[static_cast<std::size_t>(chosen[i])], 0);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(overlap(c.tree, chosen[i], chosen[j]));
    }
    EXPECT_NEAR(sum, best_by_trying_all(c), 1e-5);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Selection, testing::Range(0U, 40U));

TEST(SelectionErrors, CountsMustAgree) {
    const Case c = made_up(3, 2);
    EXPECT_THAT(
        [&] { select_regions(c.tree, std::vector<float>{1.0F}); },
        testing::ThrowsMessage<InvalidInput>("the tree has 5 regions but 1 worths are given"));
}

}  // namespace
}  // namespace scree::vision
