#pragma once

#include "vision/classical/merge_tree.h"
#include "vision/classical/mlp.h"
#include "vision/classical/outline_features.h"
#include "vision/classical/region_features.h"

#include <span>
#include <vector>

namespace scree::vision {

/// What is expected of a candidate, learned from labelled photographs.
struct RegionScore {
    float match = 0;    ///< Chance that it overlaps a whole rock by more than a half.
    float overlap = 0;  ///< Expected overlap (intersection over union) with the best rock.
};

/// The two networks that score candidates: a cheap one for all regions of a hierarchy, and one
/// that also looks along the outline for those that passed.
struct ScoreModel {
    Mlp region;
    Mlp outline;
};

/// The model that training/train_score.py wrote.
const ScoreModel& trained_score_model();

/// Read both networks, one after the other, from read_mlp()'s numbers.
ScoreModel read_score_model(std::span<const double> numbers);

/// First score of every region of at least `least_area` pixels; smaller ones get zero.
std::vector<RegionScore> score_regions(const MergeTree& tree, double least_area, const Mlp& model);

/// What the second network reads.
using CandidateFeatures = std::array<float, kRegionFeatures + kOutlineFeatures>;

/// Features of a region and of its outline, in this order.
CandidateFeatures candidate_features(const MergeTree& tree, int region, const Outline& outline,
                                     const EdgeField& field);

/// Second score of each candidate.
std::vector<RegionScore> score_candidates(std::span<const CandidateFeatures> candidates,
                                          const Mlp& model);

}  // namespace scree::vision
