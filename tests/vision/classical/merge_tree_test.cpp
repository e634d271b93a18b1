#include "vision/classical/merge_tree.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

struct Scene {
    EdgeField field;
    FloatRaster luma;
    BasinMap basins;
};

// A lattice of basins with borders of varied strength, and a strip that belongs to none.
Scene lattice(unsigned seed) {
    constexpr int kWidth = 48, kHeight = 40, kCell = 8;
    Scene scene{{FloatRaster(kWidth, kHeight), FloatRaster(kWidth, kHeight, 0.9F),
                 FloatRaster(kWidth, kHeight, 0.3F)},
                FloatRaster(kWidth, kHeight, 0.5F),
                {Raster<std::int32_t>(kWidth, kHeight, kNoBasin), 0}};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const unsigned cell = static_cast<unsigned>(y / kCell * (kWidth / kCell) + x / kCell);
            scene.field.boundary(x, y) =
                static_cast<float>(((cell + seed * 131U + 1U) * 2654435761U) >> 16U) / 65536.0F;
            if (y < kHeight - kCell)
                scene.basins.labels(x, y) = static_cast<int>(cell);
        }
    scene.basins.count = (kHeight / kCell - 1) * (kWidth / kCell);
    return scene;
}

MergeTree tree_of(const Scene& scene, float highest = 1.0F) {
    return build_merge_tree(scene.basins, scene.field, scene.luma, highest);
}

class Tree : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(Tree, UnionsAreNestedAndEveryBasinIsReached) {
    const Scene scene = lattice(GetParam());
    const MergeTree tree = tree_of(scene);
    ASSERT_EQ(tree.n_basins, scene.basins.count);
    ASSERT_EQ(tree.nodes.size(), static_cast<std::size_t>(2 * tree.n_basins - 1));
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const RegionNode& node = tree.nodes[i];
        EXPECT_EQ(node.left < 0, i < static_cast<std::size_t>(tree.n_basins));
        if (node.left < 0)
            continue;
        EXPECT_LT(node.left, static_cast<int>(i));
        EXPECT_LT(node.right, static_cast<int>(i));
        const auto& a = tree.nodes[static_cast<std::size_t>(node.left)];
        const auto& b = tree.nodes[static_cast<std::size_t>(node.right)];
        EXPECT_EQ(a.parent, static_cast<int>(i));
        EXPECT_EQ(b.parent, static_cast<int>(i));
        EXPECT_DOUBLE_EQ(node.pixels.area, a.pixels.area + b.pixels.area);
    }
    EXPECT_DOUBLE_EQ(tree.nodes.back().pixels.area, 48.0 * 32.0);
}

TEST_P(Tree, BordersAddUpToWhatALookAtThePixelsGives) {
    const Scene scene = lattice(GetParam());
    const MergeTree tree = tree_of(scene);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        std::set<int> members;
        std::vector<int> open = {static_cast<int>(i)};
        while (!open.empty()) {
            const RegionNode& node = tree.nodes[static_cast<std::size_t>(open.back())];
            if (node.left < 0)
                members.insert(open.back());
            open.pop_back();
            if (node.left >= 0)
                open.insert(open.end(), {node.left, node.right});
        }
        double length = 0, sum = 0, frame = 0;
        const auto& labels = scene.basins.labels;
        for (int y = 0; y < labels.height(); ++y)
            for (int x = 0; x < labels.width(); ++x) {
                if (!members.contains(labels(x, y)))
                    continue;
                for (const auto& [u, v] :
                     {std::pair{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
                    if (!labels.contains(u, v)) {
                        frame += 1;
                    } else if (!members.contains(labels(u, v))) {
                        length += 1;
                        sum += std::max(scene.field.boundary(x, y), scene.field.boundary(u, v));
                    }
                }
            }
        const RegionNode& node = tree.nodes[i];
        EXPECT_NEAR(node.outer.length, length, 1e-3);
        EXPECT_NEAR(node.outer.sum, sum, 1e-2);
        EXPECT_NEAR(node.frame, frame, 1e-3);
    }
}

TEST_P(Tree, StrongBordersStay) {
    const MergeTree tree = tree_of(lattice(GetParam()), 0.5F);
    for (const auto& node : tree.nodes)
        EXPECT_LE(node.height, 0.5F);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Tree, testing::Range(0U, 6U));

// Two basins side by side whose distance channel peaks in each and falls to `pass` between them.
MergeTree pair(float pass) {
    FloatRaster distance(20, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 20; ++x)
            distance(x, y) = x == 9 || x == 10 ? pass : x == 4 || x == 15 ? 0.9F : 0.5F;
    BasinMap basins{Raster<std::int32_t>(20, 8), 2};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 20; ++x)
            basins.labels(x, y) = x < 10 ? 0 : 1;
    const EdgeField field{FloatRaster(20, 8, 0.4F), FloatRaster(20, 8, 0.9F), distance};
    return build_merge_tree(basins, field, FloatRaster(20, 8), 1.0F);
}

TEST(MergeTree, TellsPeaksOfTheDistanceChannelApart) {
    const RegionNode two = pair(0.1F).nodes.back();
    EXPECT_FLOAT_EQ(two.pass, 0.1F);
    EXPECT_FLOAT_EQ(two.split, 0.8F);
    EXPECT_EQ(two.peaks, 2);
    EXPECT_NEAR(two.removed.depth / two.removed.length, 0.1, 1e-6);
    const RegionNode one = pair(0.85F).nodes.back();
    EXPECT_EQ(one.peaks, 1);
    EXPECT_NEAR(one.split, 0.05, 1e-6);
}

TEST(MergeTree, OfNoBasinsIsEmpty) {
    Scene scene = lattice(0);
    scene.basins = {Raster<std::int32_t>(48, 40, kNoBasin), 0};
    EXPECT_TRUE(tree_of(scene).nodes.empty());
}

}  // namespace
}  // namespace scree::vision
