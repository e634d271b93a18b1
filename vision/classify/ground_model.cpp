#include "vision/classify/ground_model.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <vector>

namespace scree::vision {

namespace {

constexpr std::size_t kTerms = GroundModel::kTerms;
constexpr float kReach = 3.0F;
constexpr double kShipped[] = {
#include "vision/classify/ground_weights.inc"
};
static_assert(std::size(kShipped) == 2 * kGroundFeatures + kGroundClasses * kTerms);

using Terms = std::array<float, kTerms>;

Terms terms_of(const GroundModel& model, const GroundFeatures& features) {
    Terms terms{};
    terms[0] = 1.0F;
    for (std::size_t i = 0; i < kGroundFeatures; ++i) {
        const float z =
            std::clamp((features[i] - model.mean[i]) / model.deviation[i], -kReach, kReach);
        terms[1 + i] = z;
        terms[1 + kGroundFeatures + i] = 0.5F * (z * z - 1.0F);
    }
    return terms;
}

template <class Weights>
ClassScores scores_of(const Weights& weights, const Terms& terms) {
    ClassScores scores{};
    for (std::size_t c = 0; c < kGroundClasses; ++c)
        for (std::size_t t = 0; t < kTerms; ++t)
            scores[c] += static_cast<double>(weights[c][t]) * static_cast<double>(terms[t]);
    const double greatest = *std::max_element(scores.begin(), scores.end());
    double sum = 0.0;
    for (const double score : scores)
        sum += std::exp(score - greatest);
    for (double& score : scores)
        score -= greatest + std::log(sum);
    return scores;
}

void standardise(std::span<const GroundFeatures> features, GroundModel& model) {
    const auto n = static_cast<double>(features.size());
    for (std::size_t i = 0; i < kGroundFeatures; ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (const GroundFeatures& sample : features) {
            sum += static_cast<double>(sample[i]);
            squares += static_cast<double>(sample[i]) * static_cast<double>(sample[i]);
        }
        const double mean = sum / n;
        model.mean[i] = static_cast<float>(mean);
        model.deviation[i] =
            static_cast<float>(std::sqrt(std::max(squares / n - mean * mean, 1e-12)));
    }
}

using Table = std::array<std::array<double, kTerms>, kGroundClasses>;

struct Sample {
    Terms terms;
    std::size_t kind;
    double weight;
};

std::vector<Sample> samples_of(std::span<const GroundFeatures> features,
                               std::span<const GroundClass> classes, const GroundModel& model) {
    std::array<double, kGroundClasses> counts{};
    for (const GroundClass kind : classes)
        counts[static_cast<std::size_t>(kind)] += 1.0;
    std::vector<Sample> samples(features.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto kind = static_cast<std::size_t>(classes[i]);
        samples[i] = {terms_of(model, features[i]), kind,
                      1.0 / (counts[kind] * static_cast<double>(kGroundClasses))};
    }
    return samples;
}

// Gradient of the mean negative logarithmic likelihood and of the shrinkage; pieces of a fixed size
// are summed in order, so that threads do not change the result.
Table gradient_at(const Table& weights, const std::vector<Sample>& samples, double shrinkage) {
    constexpr std::size_t kPiece = 512;
    std::vector<Table> parts((samples.size() + kPiece - 1) / kPiece);
    parallel_for_each_index(0, parts.size(), 1, [&](std::size_t part) {
        const std::size_t last = std::min(samples.size(), (part + 1) * kPiece);
        for (std::size_t i = part * kPiece; i < last; ++i) {
            const Sample& sample = samples[i];
            const ClassScores scores = scores_of(weights, sample.terms);
            for (std::size_t c = 0; c < kGroundClasses; ++c) {
                const double miss =
                    sample.weight * (std::exp(scores[c]) - (c == sample.kind ? 1.0 : 0.0));
                for (std::size_t t = 0; t < kTerms; ++t)
                    parts[part][c][t] += miss * static_cast<double>(sample.terms[t]);
            }
        }
    });
    Table gradient{};
    for (const Table& part : parts)
        for (std::size_t c = 0; c < kGroundClasses; ++c)
            for (std::size_t t = 0; t < kTerms; ++t)
                gradient[c][t] += part[c][t];
    for (std::size_t c = 0; c < kGroundClasses; ++c)
        for (std::size_t t = 1; t < kTerms; ++t)
            gradient[c][t] += shrinkage * weights[c][t];
    return gradient;
}

}  // namespace

ClassScores log_probabilities(const GroundModel& model, const GroundFeatures& features) {
    return scores_of(model.weights, terms_of(model, features));
}

GroundModel train_ground_model(std::span<const GroundFeatures> features,
                               std::span<const GroundClass> classes,
                               const TrainingOptions& options) {
    if (features.empty() || features.size() != classes.size())
        fail<InvalidInput>("there are ", features.size(), " samples and ", classes.size(),
                           " classes, they must be as many and at least one");
    GroundModel model;
    standardise(features, model);
    const std::vector<Sample> samples = samples_of(features, classes, model);
    double square = 0.0;
    for (const Sample& sample : samples)
        square += sample.weight *
                  static_cast<double>(std::inner_product(sample.terms.begin(), sample.terms.end(),
                                                         sample.terms.begin(), 0.0F));
    const double step = 1.0 / (0.5 * square + options.shrinkage);  // one over the curvature's bound
    Table weights{};
    Table ahead{};
    for (int round = 0; round < options.rounds; ++round) {
        const Table gradient = gradient_at(ahead, samples, options.shrinkage);
        const double momentum = static_cast<double>(round) / (round + 3.0);
        for (std::size_t c = 0; c < kGroundClasses; ++c)
            for (std::size_t t = 0; t < kTerms; ++t) {
                const double next = ahead[c][t] - step * gradient[c][t];
                ahead[c][t] = next + momentum * (next - weights[c][t]);
                weights[c][t] = next;
            }
    }
    for (std::size_t c = 0; c < kGroundClasses; ++c)
        for (std::size_t t = 0; t < kTerms; ++t)
            model.weights[c][t] = static_cast<float>(weights[c][t]);
    return model;
}

std::string describe_model(const GroundModel& model) {
    struct Row {
        std::size_t feature;
        double strength;
    };
    std::vector<Row> rows;
    for (std::size_t i = 0; i < kGroundFeatures; ++i) {
        double squares = 0.0;
        for (const std::size_t t : {1 + i, 1 + kGroundFeatures + i})
            for (const auto& weights : model.weights)
                squares += static_cast<double>(weights[t]) * static_cast<double>(weights[t]);
        rows.push_back({i, std::sqrt(squares / kGroundClasses)});
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row& a, const Row& b) { return a.strength > b.strength; });
    std::ostringstream text;
    text << std::fixed << std::setprecision(2);
    for (const Row& row : rows) {
        text << std::left << std::setw(20) << kGroundFeatureNames[row.feature] << std::right
             << std::setw(6) << row.strength << " ";
        for (std::size_t c = 0; c < kGroundClasses; ++c)
            text << "  " << kGroundClassNames[c] << std::showpos << std::setw(6)
                 << model.weights[c][1 + row.feature] << "/" << std::setw(5)
                 << model.weights[c][1 + kGroundFeatures + row.feature] << std::noshowpos;
        text << "\n";
    }
    return text.str();
}

const GroundModel& shipped_ground_model() {
    static const GroundModel model = [] {
        GroundModel read;
        const double* next = kShipped;
        for (GroundFeatures* values : {&read.mean, &read.deviation})
            for (float& value : *values)
                value = static_cast<float>(*next++);
        for (auto& weights : read.weights)
            for (float& value : weights)
                value = static_cast<float>(*next++);
        return read;
    }();
    return model;
}

}  // namespace scree::vision
