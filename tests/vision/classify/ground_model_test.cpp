#include "vision/classify/ground_model.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree::vision {
namespace {

struct Samples {
    std::vector<GroundFeatures> features;
    std::vector<GroundClass> classes;
};

// Every class has a mean of its own in two features; a fourth of the samples are sand.
Samples clouds(std::size_t n, std::uint64_t seed) {
    Rng rng({.seed = seed});
    Samples samples;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t kind = rng.uniform() < 0.25 ? 0 : rng.below(kGroundClasses);
        GroundFeatures features{};
        for (float& value : features)
            value = static_cast<float>(rng.normal());
        features[3] += 6.0F * static_cast<float>(std::cos(1.2566 * static_cast<double>(kind)));
        features[7] += 6.0F * static_cast<float>(std::sin(1.2566 * static_cast<double>(kind)));
        samples.features.push_back(features);
        samples.classes.push_back(static_cast<GroundClass>(kind));
    }
    return samples;
}

GroundModel trained(const Samples& samples, int rounds = 200) {
    return train_ground_model(samples.features, samples.classes, {.rounds = rounds});
}

std::size_t best(const ClassScores& scores) {
    return static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) -
                                    scores.begin());
}

TEST(GroundModel, LearnsCloudsAndFindsThemInOtherSamples) {
    const GroundModel model = trained(clouds(800, 1));
    const Samples others = clouds(500, 2);
    int right = 0;
    for (std::size_t i = 0; i < others.features.size(); ++i)
        right += best(log_probabilities(model, others.features[i])) ==
                         static_cast<std::size_t>(others.classes[i])
                     ? 1
                     : 0;
    EXPECT_GT(right, 475);
}

TEST(GroundModel, ProbabilitiesSumToOneFarOutToo) {
    GroundFeatures features{};
    for (const float value : {0.0F, 1.0F, -50.0F, 1e6F}) {
        features.fill(value);
        double sum = 0.0;
        for (const double score : log_probabilities(shipped_ground_model(), features))
            sum += std::exp(score);
        EXPECT_NEAR(sum, 1.0, 1e-9);
    }
}

TEST(GroundModel, NamesTheFeaturesThatDecideFirst) {
    const std::string text = describe_model(trained(clouds(800, 1)));
    const std::size_t chroma = text.find(kGroundFeatureNames[3]);
    const std::size_t detail = text.find(kGroundFeatureNames[7]);
    const std::size_t second_line = text.find('\n') + 1;
    EXPECT_LT(std::min(chroma, detail), second_line);
    EXPECT_LT(std::max(chroma, detail), text.find('\n', second_line));
}

TEST(GroundModel, TrainingGivesTheSameWeightsForAnyNumberOfThreads) {
    const Samples samples = clouds(1500, 3);
    const auto run = [&](int n_threads) {
        const ThreadLimit limit(n_threads);
        return trained(samples, 20).weights;
    };
    EXPECT_EQ(run(1), run(4));
}

TEST(GroundModelErrors, NameTheCounts) {
    const std::vector<GroundFeatures> features(3);
    const std::vector<GroundClass> classes(2);
    EXPECT_THAT([&] { train_ground_model(features, classes); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("3 samples and 2")));
}

}  // namespace
}  // namespace scree::vision
