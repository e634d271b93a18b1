#pragma once

#include "vision/outline.h"
#include "vision/thesis/slice_finder.h"
#include "vision/thesis/thesis_options.h"

namespace scree::vision {

/// The source's module ContourFinder behind the exchangeable interface: rays over the pixels whose
/// boundary channel is at least one half, whoever filled it.
///
/// Works at the working width; outlines are given in the photograph's pixels.
class RayOutlineFinder final : public OutlineFinder {
public:
    explicit RayOutlineFinder(const ThesisOptions& options = {});
    std::vector<Outline> find(const Photo& photo, const EdgeField& field,
                              Progress* progress = nullptr) const override;

private:
    ThesisOptions options_;
};

/// The outlines of slices in a picture that is `scale` times as large, ordered as an
/// OutlineFinder promises: by falling confidence, ties by row then column.
std::vector<Outline> ordered_outlines(const std::vector<Slice>& slices, glm::dvec2 scale);

}  // namespace scree::vision
