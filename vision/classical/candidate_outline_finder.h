#pragma once

#include "vision/classical/region_score.h"
#include "vision/outline.h"

namespace scree::vision {

struct CandidateOptions {
    double min_size = 8.0;  ///< Least equivalent diameter of a rock, pixels.
    double caution = 0.38;  ///< Worth that a region must exceed to be called a rock.
    double smooth = 1.5;    ///< Smoothing along an outline, pixels.
};

template <class Visitor>
void describe(CandidateOptions& o, Visitor&& field) {
    field("min-size", o.min_size,
          {.min = 3, .max = 10000, .unit = "px", .help = "least equivalent diameter of a rock"});
    field("caution", o.caution,
          {.min = 0, .max = 1, .help = "how sure to be of a rock: fewer false ones, more missed"});
    field("smooth", o.smooth,
          {.min = 0, .max = 20, .unit = "px", .help = "smoothing along an outline"});
}

/// Outlines by choosing among candidates: regions of a hierarchy cut from the edge field, each
/// with a learned score; the set with the greatest total worth is taken.
///
/// Works on any edge field whose channels have their stated meaning. Missing inside and distance
/// channels are made from the boundary.
class CandidateOutlineFinder : public OutlineFinder {
public:
    /// @throw InvalidOption  a value is outside the range that describe() gives.
    /// @param score  What estimates a candidate's worth; must outlive the finder.
    explicit CandidateOutlineFinder(const CandidateOptions& options = {},
                                    const ScoreModel& score = trained_score_model());

    std::vector<Outline> find(const Photo& photo, const EdgeField& field,
                              Progress* progress = nullptr) const override;

private:
    CandidateOptions options_;
    const ScoreModel* score_;
};

}  // namespace scree::vision
