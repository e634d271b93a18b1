#include "vision/thesis/edge_linking.h"

#include "base/random.h"
#include "tests/vision/thesis/masks.h"
#include "vision/thesis/thesis_edge_detector.h"
#include "vision/thesis/thinning.h"

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

int count(const Mask& mask) {
    return static_cast<int>(std::count(mask.begin(), mask.end(), 1));
}

int pieces(const Mask& mask) {
    int n = 0;
    Mask left = mask;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            if (left(x, y) == 0)
                continue;
            ++n;
            std::vector<glm::ivec2> open{{x, y}};
            left(x, y) = 0;
            while (!open.empty()) {
                const glm::ivec2 p = open.back();
                open.pop_back();
                for (int v = p.y - 1; v <= p.y + 1; ++v)
                    for (int u = p.x - 1; u <= p.x + 1; ++u)
                        if (left.contains(u, v) && left(u, v) != 0) {
                            left(u, v) = 0;
                            open.emplace_back(u, v);
                        }
            }
        }
    return n;
}

TEST(Thinning, BarBecomesALine) {
    Mask bar(40, 20);
    for (int y = 7; y < 12; ++y)
        for (int x = 5; x < 35; ++x)
            bar(x, y) = 1;
    const Mask line = thinned(bar);
    EXPECT_LT(count(line), 32);
    EXPECT_GT(count(line), 22);
    EXPECT_EQ(pieces(line), 1);
    EXPECT_EQ(line_ends(line).size(), 2U);
    EXPECT_EQ(thinned(line), line) << "thinning a thin line changes nothing";
}

TEST(Thinning, KeepsThePiecesOfRandomBlots) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Rng rng({.seed = seed});
        Mask blots(60, 50);
        for (int i = 0; i < 25; ++i) {
            const int x0 = static_cast<int>(rng.below(54));
            const int y0 = static_cast<int>(rng.below(44));
            for (int y = y0; y < y0 + 3 + i % 4; ++y)
                for (int x = x0; x < x0 + 3 + i % 3; ++x)
                    blots(x, y) = 1;
        }
        const Mask lines = thinned(blots);
        EXPECT_EQ(pieces(lines), pieces(blots));
        for (std::size_t i = 0; i < lines.size(); ++i)
            ASSERT_LE(lines.data()[i], blots.data()[i]);
    }
}

TEST(Linking, JoinsLinesAcrossAGapWithinReach) {
    for (const int gap : {2, 4, 6, 9}) {
        Mask lines(60, 21);
        test::draw(lines, {5.5, 10.5}, {24.5, 10.5});
        test::draw(lines, {24.5 + gap, 10.5}, {50.5, 10.5});
        EXPECT_EQ(pieces(linked(lines, {})), gap <= 5 ? 1 : 2) << gap;
    }
}

TEST(Linking, PrefersAnEndToANearerEdgeAndLooksAheadOnly) {
    Mask lines(60, 40);
    test::draw(lines, {5.5, 20.5}, {24.5, 20.5});
    test::draw(lines, {29.5, 20.5}, {50.5, 20.5});
    test::draw(lines, {26.5, 23.5}, {26.5, 35.5});
    EXPECT_EQ(linked(lines, {})(27, 20), 1);
    Mask beside(60, 40);
    test::draw(beside, {5.5, 20.5}, {24.5, 20.5});
    test::draw(beside, {10.5, 23.5}, {30.5, 23.5});
    const Mask joined = linked(beside, {});
    EXPECT_EQ(pieces(joined), 1) << "the edge lies 45 degrees ahead";
    ThesisOptions narrow;
    narrow.link_angle = 30;
    EXPECT_EQ(linked(beside, narrow), beside);
}

TEST(Linking, DeletesSmallPiecesOnly) {
    Mask lines(40, 20);
    test::draw(lines, {2.5, 5.5}, {8.5, 5.5});    // 7 pixels
    test::draw(lines, {2.5, 12.5}, {9.5, 12.5});  // 8 pixels
    EXPECT_EQ(count(without_small_pieces(lines, 8)), 8);
}

TEST(Linking, EndsFallAndRecallDoesNotOnGroundTruth) {
    std::size_t n_before = 0;
    std::size_t n_after = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        auto options = test::suited_picture(seed);
        options.width = 300;
        options.height = 220;
        options.gap = 2;
        options.contrast = 0.5;
        const auto made = test::make_synthetic_photo(options);
        ThesisOptions faint;
        faint.bright_share = 0.1;
        const Mask before = thinned(detect_thesis_edges(made.photo, faint).thresholded);
        const Mask after = linked(before, faint);
        n_before += line_ends(before).size();
        n_after += line_ends(after).size();
        EXPECT_GE(test::mask_quality(after, made.labels).recall,
                  test::mask_quality(before, made.labels).recall);
        EXPECT_GE(test::mask_quality(without_small_pieces(after, 8), made.labels).recall,
                  test::mask_quality(before, made.labels).recall - 0.002);
    }
    EXPECT_LT(n_after, n_before);
}

}  // namespace
}  // namespace scree::vision
