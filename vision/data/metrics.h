#pragma once

#include "base/raster.h"

#include <span>

namespace scree::vision {

/// How well a label map agrees with a hand-made one. A rock of one matches a rock of the other
/// if their intersection over union (IoU) is above a threshold; above 0.5 no rock has two matches.
/// With T matches of n_truth and n_found rocks, AP = T / (n_truth + n_found - T).
struct LabelScore {
    double n_truth = 0.0;         ///< Rocks in the truth; a mean may be no whole number.
    double n_found = 0.0;         ///< Rocks in the scored map.
    double true_positives = 0.0;  ///< Matches at 0.5.
    double ap50 = 0.0;            ///< AP at 0.5.
    double ap75 = 0.0;            ///< AP at 0.75.
    double map = 0.0;             ///< Mean of AP at 0.50, 0.55 ... 0.90.
    double f1 = 0.0;              ///< 2 T / (n_truth + n_found) at 0.5.
    double iou = 0.0;             ///< Mean IoU of the matches at 0.5; 0 without any.
    double cover = 0.0;           ///< IoU of all rocks taken as one mask; 0 if both are empty.
    double d50_error = 0.0;       ///< |D - truth's D| / truth's D, median equivalent diameter.
    double d84_error = 0.0;       ///< The same for the 84th percentile; 1 if either map is empty.
};

/// Score `found` against `truth`.
///
/// Rocks are the distinct values other than 0; those that touch the border count like all others.
/// @throw InvalidInput  the sizes differ.
LabelScore score_labels(const LabelMap& found, const LabelMap& truth);

/// Mean of every figure. @throw InvalidInput  there is none.
LabelScore mean_score(std::span<const LabelScore> scores);

/// Percentile of ascending values, interpolated linearly between the two nearest ranks: rank
/// q / 100 * (n - 1). @pre `sorted` is ascending and holds at least one value; q in [0, 100].
double percentile(std::span<const double> sorted, double q);

}  // namespace scree::vision
