#include "vision/classical/region_score.h"

#include <cmath>

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

TEST(RegionScore, AClearBorderIsWorthMoreThanAFaintOne) {
    const ScoreModel& model = trained_score_model();
    EdgeField clear_field, faint_field;
    const MergeTree clear = disc(0.95F, clear_field), faint = disc(0.15F, faint_field);
    const float good = score_regions(clear, 50, model.region)[0].match;
    EXPECT_GT(good, 0.5F);
    EXPECT_GT(good, score_regions(faint, 50, model.region)[0].match);

    const CandidateFeatures both[] = {candidate_features(clear, 0, circle(), clear_field),
                                      candidate_features(faint, 0, circle(), faint_field)};
    const auto again = score_candidates(both, model.outline);
    EXPECT_GT(again[0].match, 0.5F);
    EXPECT_GT(again[0].match, again[1].match);
    EXPECT_GT(again[0].overlap, again[1].overlap);
}

TEST(RegionScore, SmallRegionsGetNone) {
    EdgeField field;
    EXPECT_EQ(score_regions(disc(0.9F, field), 5000, trained_score_model().region)[0].match, 0.0F);
}

TEST(RegionScore, BothNetworksFitTheirFeatures) {
    EXPECT_EQ(trained_score_model().region.n_in(), kRegionFeatures);
    EXPECT_EQ(trained_score_model().outline.n_in(), kRegionFeatures + kOutlineFeatures);
}

}  // namespace
}  // namespace scree::vision
