#pragma once

#include "vision/classify/ground_classes.h"
#include "vision/classify/ground_features.h"

#include <span>
#include <string>

namespace scree::vision {

/// A multinomial logistic regression on the features and their squares: what it knows is a table of
/// weights with a name for every row.
struct GroundModel {
    static constexpr std::size_t kTerms = 1 + 2 * kGroundFeatures;

    GroundFeatures mean{};       ///< Of the training data, taken off first.
    GroundFeatures deviation{};  ///< Divided by next; results are held to [-3, 3].
    /// For each class a constant, a weight for each feature and one for each feature's square.
    std::array<std::array<float, kTerms>, kGroundClasses> weights{};
};

using ClassScores = std::array<double, kGroundClasses>;

/// Logarithms of the classes' probabilities.
ClassScores log_probabilities(const GroundModel& model, const GroundFeatures& features);

/// How much each feature decides: the deviation over classes of its two weights, the largest first,
/// with the class that it speaks for where it is high. One line each.
std::string describe_model(const GroundModel& model);

struct TrainingOptions {
    int rounds = 1000;
    double shrinkage = 1e-3;  ///< Weight of the squares of the weights.
};

/// Fit to samples: the regularised likelihood by accelerated gradient descent, from zero weights.
/// Every class counts the same, however many samples it has.
/// @pre  As many classes as features, at least one sample.
GroundModel train_ground_model(std::span<const GroundFeatures> features,
                               std::span<const GroundClass> classes,
                               const TrainingOptions& options = {});

/// The weights that ship with the toolkit, trained on made-up pictures alone by
/// vision/training/train_ground.cpp.
const GroundModel& shipped_ground_model();

}  // namespace scree::vision
