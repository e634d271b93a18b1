#include "vision/classical/region_score.h"

#include "base/error.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// A disc of one basin on open ground whose border is as strong as told.
MergeTree disc(float strength, EdgeField& field) {
    constexpr int kSize = 80;
    field = {FloatRaster(kSize, kSize), FloatRaster(kSize, kSize, 0.1F), FloatRaster(kSize, kSize)};
    BasinMap basins{Raster<std::int32_t>(kSize, kSize, kNoBasin), 1};
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const double away = std::hypot(x + 0.5 - 40, y + 0.5 - 40) - 25;
            field.boundary(x, y) = strength * static_cast<float>(std::exp(-away * away / 2));
            if (away >= 0)
                continue;
            basins.labels(x, y) = 0;
            field.inside(x, y) = 0.95F;
            field.distance(x, y) = static_cast<float>(-0.8 * away / 25);
        }
    return build_merge_tree(basins, field, FloatRaster(kSize, kSize, 0.5F), 1.0F);
}

Outline circle() {
    Outline o;
    o.centre = {40, 40};
    o.radii.fill(25);
    return o;
}

// Of the classical scores alone: a learned field never shows a faint border about a full cone of
// distance, so its scores are not held to such a scene.
TEST(RegionScore, AClearBorderIsWorthMoreThanAFaintOne) {
    const ScoreModel& model = trained_score_model();
    EdgeField clear_field, faint_field;
    const MergeTree clear = disc(0.95F, clear_field), faint = disc(0.15F, faint_field);
    const float good = score_regions(clear, model.region)[0].match;
    EXPECT_GT(good, 0.5F);
    EXPECT_GT(good, score_regions(faint, model.region)[0].match);

    const auto features_of = [&](const MergeTree& tree, const EdgeField& field) {
        const auto first = score_regions(tree, model.region);
        return candidate_features(tree, 0, circle(), field, region_contexts(tree, first)[0]);
    };
    const CandidateFeatures both[] = {features_of(clear, clear_field),
                                      features_of(faint, faint_field)};
    const auto again = score_candidates(both, model.outline);
    EXPECT_GT(again[0].match, 0.5F);
    EXPECT_GT(again[0].match, again[1].match);
    EXPECT_GT(again[0].overlap, again[1].overlap);
}

TEST(RegionScore, SmallRegionsGetNone) {
    EdgeField field{FloatRaster(9, 9), FloatRaster(9, 9, 0.9F), FloatRaster(9, 9, 0.5F)};
    BasinMap basins{Raster<std::int32_t>(9, 9, kNoBasin), 1};
    for (int i = 0; i < static_cast<int>(kLeastScoredArea) - 1; ++i)
        basins.labels(i % 7, i / 7) = 0;
    const auto tree = build_merge_tree(basins, field, FloatRaster(9, 9), 1.0F);
    EXPECT_EQ(score_regions(tree, trained_score_model().region)[0].match, 0.0F);
}

TEST(RegionScore, NetworksAreAveraged) {
    const Mlp& network = trained_score_model().outline.front();
    Mlp other = network;
    for (float& bias : other.layers.back().bias)
        bias += 1;
    const CandidateFeatures some[] = {CandidateFeatures{}};
    const auto alone = score_candidates(some, std::vector<Mlp>{network})[0];
    const auto shifted = score_candidates(some, std::vector<Mlp>{other})[0];
    const auto both = score_candidates(some, std::vector<Mlp>{network, other})[0];
    EXPECT_NEAR(both.match, 0.5F * (alone.match + shifted.match), 1e-6);
    EXPECT_NEAR(both.overlap, 0.5F * (alone.overlap + shifted.overlap), 1e-6);
}

TEST(RegionScore, BothNetworksFitTheirFeatures) {
    for (const ScoreModel* model : {&trained_score_model(), &learned_score_model()}) {
        EXPECT_EQ(model->region.n_in(), kRegionFeatures);
        ASSERT_FALSE(model->outline.empty());
        for (const Mlp& network : model->outline)
            EXPECT_EQ(network.n_in(), kCandidateFeatures);
    }
}

TEST(RegionScore, TablesThatDoNotFitAreRefused) {
    const auto message = [](const std::vector<double>& numbers) -> std::string {
        try {
            read_score_model(numbers);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(message({}), "a score model must begin with its least inside value, in (0, 1)");
    EXPECT_EQ(message({7.0, 1.0, 2.0, 1.0}), message({}));
    EXPECT_EQ(message({0.3, 1, 2, 1, 0.5, 0.5, 0, 1, 1, 1, 0.5, 0}),
              "a network of the score has 2 inputs and 1 outputs, must have " +
                  std::to_string(kRegionFeatures) + " and 3");
    EXPECT_NE(message({0.3, 1, 2, 1, 0.5, 0.5, 0}), "") << "the second network is missing";
}

}  // namespace
}  // namespace scree::vision
