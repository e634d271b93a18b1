#include "vision/classical/region_score.h"

#include "base/error.h"
#include "base/parallel.h"
#include "vision/classical/field_model.h"

#include <algorithm>
#include <array>

namespace scree::vision {
namespace {

// Written by vision/training/train_score.py.
constexpr double kScoreNumbers[] = {
#include "vision/classical/score_weights.inc"
};

constexpr double kLearnedScoreNumbers[] = {
#include "vision/classical/learned_score_weights.inc"
};

constexpr std::size_t kOutputs = 3;  // overlap above 0.5, above 0.7, the overlap itself

void check_network(const Mlp& network, int n_features) {
    if (network.n_in() != n_features || network.n_out() != static_cast<int>(kOutputs))
        fail<InvalidInput>("a network of the score has ", network.n_in(), " inputs and ",
                           network.n_out(), " outputs, must have ", n_features, " and ", kOutputs);
}

// Score up to kMlpBlock candidates; `features(k)` gives those of the k-th.
template <std::size_t kCount, class Features>
std::array<RegionScore, kMlpBlock> score_block(const Mlp& model, int n, Features features) {
    std::array<std::array<float, kMlpBlock>, kCount> values;
    for (int k = 0; k < n; ++k) {
        const auto row = features(k);
        for (std::size_t i = 0; i < kCount; ++i)
            values[i][static_cast<std::size_t>(k)] = row[i];
    }
    std::array<const float*, kCount> inputs;
    for (std::size_t i = 0; i < kCount; ++i)
        inputs[i] = values[i].data();
    std::array<std::array<float, kMlpBlock>, kOutputs> results;
    const std::array<float*, kOutputs> outputs = {results[0].data(), results[1].data(),
                                                  results[2].data()};
    MlpScratch scratch;
    evaluate_block(model, inputs, n, outputs, scratch);
    std::array<RegionScore, kMlpBlock> scores;
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
        scores[k] = {results[0][k], results[2][k]};
    return scores;
}

}  // namespace

ScoreModel read_score_model(std::span<const double> numbers) {
    if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] < 1.0))
        fail<InvalidInput>("a score model must begin with its least inside value, in (0, 1)");
    ScoreModel model;
    model.hierarchy.inside = numbers[0];
    numbers = numbers.subspan(1);
    model.region = read_mlp(numbers);
    do
        model.outline.push_back(read_mlp(numbers));
    while (!numbers.empty());
    check_network(model.region, kRegionFeatures);
    for (const Mlp& network : model.outline)
        check_network(network, kCandidateFeatures);
    return model;
}

const ScoreModel& trained_score_model() {
    static const ScoreModel model = read_score_model(kScoreNumbers);
    return model;
}

const ScoreModel& learned_score_model() {
    static const ScoreModel model = read_score_model(kLearnedScoreNumbers);
    return model;
}

std::vector<RegionScore> score_regions(const MergeTree& tree, const Mlp& model) {
    std::vector<int> regions;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        if (tree.nodes[i].pixels.area >= kLeastScoredArea)
            regions.push_back(static_cast<int>(i));
    std::vector<RegionScore> scores(tree.nodes.size());
    parallel_for(0, regions.size(), kMlpBlock, [&](std::size_t first, std::size_t last) {
        const auto block =
            score_block<kRegionFeatures>(model, static_cast<int>(last - first), [&](int k) {
                return region_features(tree, regions[first + static_cast<std::size_t>(k)]);
            });
        for (std::size_t k = first; k < last; ++k)
            scores[static_cast<std::size_t>(regions[k])] = block[k - first];
    });
    return scores;
}

CandidateFeatures candidate_features(const MergeTree& tree, int region, const Outline& outline,
                                     const EdgeField& field, const ContextFeatures& context) {
    CandidateFeatures features;
    const auto of_region = region_features(tree, region);
    const auto of_outline = outline_features(outline, field);
    auto to = std::copy(of_region.begin(), of_region.end(), features.begin());
    to = std::copy(of_outline.begin(), of_outline.end(), to);
    std::copy(context.begin(), context.end(), to);
    return features;
}

std::vector<RegionScore> score_candidates(std::span<const CandidateFeatures> candidates,
                                          std::span<const Mlp> networks) {
    std::vector<RegionScore> scores(candidates.size());
    const auto share = 1.0F / static_cast<float>(networks.size());
    parallel_for(0, candidates.size(), kMlpBlock, [&](std::size_t first, std::size_t last) {
        for (const Mlp& network : networks) {
            const auto block = score_block<kCandidateFeatures>(
                network, static_cast<int>(last - first),
                [&](int k) { return candidates[first + static_cast<std::size_t>(k)]; });
            for (std::size_t k = first; k < last; ++k) {
                scores[k].match += share * block[k - first].match;
                scores[k].overlap += share * block[k - first].overlap;
            }
        }
    });
    return scores;
}

}  // namespace scree::vision
