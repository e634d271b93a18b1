#pragma once

#include "base/options.h"
#include "base/raster.h"
#include "vision/thesis/thesis_options.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scree::vision {

/// A photograph whose rocks are known.
struct LabelledPicture {
    Photo photo;
    LabelMap labels;
};

/// How the search for parameters runs (FW-13).
struct SearchOptions {
    int sweeps = 2;               ///< Most times that every parameter has its turn.
    double test_share = 0.5;      ///< Of the pictures, kept back from the search.
    int most_evaluations = 1000;  ///< Runs over the training pictures; ends a sweep early.
    std::uint64_t seed = 1;       ///< Shuffles pictures before the split.
};

template <class Visitor>
void describe(SearchOptions& o, Visitor&& field) {
    field("sweeps", o.sweeps, {.min = 1, .max = 100});
    field("most-evaluations", o.most_evaluations, {.min = 1, .max = 1e6});
    field("test-share", o.test_share, {.min = 0, .max = 0.9});
}

/// What the search found. Scores are mean AP50.
struct SearchReport {
    ThesisOptions best;
    double start_train_score = 0.0;
    double best_train_score = 0.0;
    double start_test_score = 0.0;  ///< On pictures that the search did not see.
    double best_test_score = 0.0;   ///< On the same.
    int n_evaluations = 0;          ///< Runs over the training pictures.
};

/// Mean AP50 of the method over pictures.
/// @pre  At least one picture.
double thesis_score(std::span<const LabelledPicture> pictures, const ThesisOptions& options);

/// Search the chain's parameters for the best mean AP50, one parameter after the other, from
/// `start` on: every candidate value of a parameter is tried with the others held.
///
/// Pictures are split once; whole pictures are held back. Deterministic.
/// @throw InvalidInput  fewer than two pictures, or a label map of another size than its photo.
SearchReport search_parameters(std::span<const LabelledPicture> pictures,
                               const ThesisOptions& start = {}, const SearchOptions& options = {});

}  // namespace scree::vision
