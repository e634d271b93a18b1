#pragma once

#include "vision/classical/merge_tree.h"
#include "vision/classical/mlp.h"
#include "vision/classical/outline_features.h"
#include "vision/classical/region_context.h"
#include "vision/classical/region_features.h"
#include "vision/classical/region_hierarchy.h"

#include <span>
#include <vector>

namespace scree::vision {

/// The networks that score candidates: a cheap one for all regions of a hierarchy, and some that
/// also look along the outline of those that passed; what these say is averaged. They belong to one
/// kind of edge field and to hierarchies that are cut from it in one way.
struct ScoreModel {
    HierarchyOptions hierarchy;
    Mlp region;
    std::vector<Mlp> outline;  ///< At least one.
};

/// The model that training/train_score.py wrote for the fields of the classical detector.
const ScoreModel& trained_score_model();

/// The model that it wrote for the fields of the learned network.
const ScoreModel& learned_score_model();

/// Read the hierarchy's least inside value, then all networks by read_mlp().
/// @throw InvalidInput  a number or the second network is missing, or a network does not fit its
/// features.
ScoreModel read_score_model(std::span<const double> numbers);

/// First score of every region of at least kLeastScoredArea pixels; smaller ones get zero.
inline constexpr double kLeastScoredArea = 35;
std::vector<RegionScore> score_regions(const MergeTree& tree, const Mlp& model);

/// What the second network reads.
inline constexpr int kCandidateFeatures = kRegionFeatures + kOutlineFeatures + kContextFeatures;
using CandidateFeatures = std::array<float, kCandidateFeatures>;

/// Features of a region, of its outline and of its context, in this order.
CandidateFeatures candidate_features(const MergeTree& tree, int region, const Outline& outline,
                                     const EdgeField& field, const ContextFeatures& context);

/// Second score of each candidate.
/// @pre At least one network.
std::vector<RegionScore> score_candidates(std::span<const CandidateFeatures> candidates,
                                          std::span<const Mlp> networks);

}  // namespace scree::vision
