#include "vision/classical/candidate_outline_finder.h"

#include "base/options.h"
#include "base/parallel.h"
#include "vision/classical/complete_field.h"
#include "vision/classical/region_hierarchy.h"
#include "vision/classical/region_outline.h"
#include "vision/classical/tree_selection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace scree::vision {
namespace {

// Least mean boundary along a rock's border, so that plain surfaces give nothing at all.
constexpr float kLeastBorder = 0.2F;
// First scores under this are not looked at again.
constexpr float kLeastMatch = 0.2F;
constexpr const char* kStage = "finding outlines";

struct Candidate {
    int region = 0;
    Outline outline;
    CandidateFeatures features{};
};

bool has_border(const RegionNode& node) {
    return node.outer.length > node.frame && node.outer.mean() >= kLeastBorder;
}

std::vector<Candidate> shortlist(const RegionHierarchy& hierarchy, const RegionIndex& index,
                                 const EdgeField& field, const std::vector<RegionScore>& scores,
                                 const CandidateOptions& options, const Progress* progress) {
    const auto& nodes = hierarchy.tree.nodes;
    const double least_area = 0.9 * 0.25 * std::numbers::pi * options.min_size * options.min_size;
    std::vector<Candidate> list;
    for (std::size_t i = 0; i < scores.size(); ++i)
        if (scores[i].match >= kLeastMatch && nodes[i].pixels.area >= least_area &&
            has_border(nodes[i]))
            list.push_back({static_cast<int>(i), {}, {}});
    const auto contexts = region_contexts(hierarchy.tree, scores);
    parallel_for_each_index(0, list.size(), 16, [&](std::size_t i) {
        stop_if_cancelled(progress, kStage);
        Candidate& c = list[i];
        const auto region = static_cast<std::size_t>(c.region);
        c.outline =
            region_outline(index, nodes[region], c.region, options.smooth, Precision::Draft);
        c.features =
            candidate_features(hierarchy.tree, c.region, c.outline, field, contexts[region]);
    });
    return list;
}

void order(std::vector<Outline>& outlines) {
    std::stable_sort(outlines.begin(), outlines.end(), [](const Outline& a, const Outline& b) {
        return std::make_tuple(-a.confidence, a.centre.y, a.centre.x) <
               std::make_tuple(-b.confidence, b.centre.y, b.centre.x);
    });
}

}  // namespace

CandidateOutlineFinder::CandidateOutlineFinder(const CandidateOptions& options,
                                               const ScoreModel& score)
    : options_(options), score_(&score) {
    check(options_);
}

std::vector<Outline> CandidateOutlineFinder::find(const Photo& photo, const EdgeField& given,
                                                  Progress* progress) const {
    EdgeField completed;
    const EdgeField& field = complete_field(photo, given, completed);
    const RegionHierarchy hierarchy = region_hierarchy(photo, field, score_->hierarchy);
    stop_if_cancelled(progress, kStage);
    const auto first = score_regions(hierarchy.tree, score_->region);
    const RegionIndex index(hierarchy);
    auto candidates = shortlist(hierarchy, index, field, first, options_, progress);
    std::vector<CandidateFeatures> features;
    std::ranges::transform(candidates, std::back_inserter(features), &Candidate::features);
    const auto scores = score_candidates(features, score_->outline);

    std::vector<float> worth(hierarchy.tree.nodes.size(), -1.0F);
    std::vector<std::size_t> candidate_of(worth.size(), 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const auto region = static_cast<std::size_t>(candidates[i].region);
        candidates[i].outline.confidence = scores[i].match;
        candidate_of[region] = i;
        if (equivalent_diameter(candidates[i].outline) >= options_.min_size)
            worth[region] =
                0.5F * (scores[i].match + scores[i].overlap) - static_cast<float>(options_.caution);
    }
    const auto chosen = select_regions(hierarchy.tree, worth);
    std::vector<Outline> outlines(chosen.size());
    parallel_for_each_index(0, chosen.size(), 16, [&](std::size_t i) {
        stop_if_cancelled(progress, kStage);
        const auto region = static_cast<std::size_t>(chosen[i]);
        outlines[i] =
            region_outline(index, hierarchy.tree.nodes[region], chosen[i], options_.smooth);
        outlines[i].confidence = candidates[candidate_of[region]].outline.confidence;
    });
    // A draft may have promised a little more than the full outline holds.
    std::erase_if(outlines,
                  [&](const Outline& o) { return equivalent_diameter(o) < options_.min_size; });
    order(outlines);
    return outlines;
}

}  // namespace scree::vision
