#pragma once

#include "base/raster.h"

namespace scree::meshing {

/// How good a height map is, measured against the truth (`rocks-and-deformer.md` part E). None of
/// the figures depends on the map's unit, offset or scale.
struct HeightComparison {
    double correlation = 0.0;  ///< Pearson correlation with the true heights, -1 to 1.
    /// Share of the variance inside rocks, away from their borders, that is finer than the filter:
    /// texture and speckles taken for relief. 0 to 1 or a little more; low is smooth.
    double fine_inside = 0.0;
    /// Mean step across the rocks' borders over the mean step between neighbours inside rocks.
    /// Above 1 the borders stand out; the true map says how far.
    double step_at_borders = 0.0;
};

struct HeightComparisonOptions {
    double filter_px = 2.0;  ///< Standard deviation of the Gaussian that parts fine from coarse.
    int border_px = 3;       ///< Pixels within this distance of a border are not inside.
};

template <class Visitor>
void describe(HeightComparisonOptions& o, Visitor&& field) {
    field("filter-px", o.filter_px, {.min = 0.5, .max = 64, .unit = "px"});
    field("border-px", o.border_px, {.min = 1, .max = 64, .unit = "px"});
}

/// Compare `heights` with `truth` where `labels` says which pixel is which rock (0 is none).
/// Figures without pixels to measure are 0.
/// @throw InvalidInput  the sizes differ, there are no pixels, or a height is no number.
/// @throw InvalidOption a value is out of its range.
HeightComparison compare_heights(const FloatRaster& heights, const FloatRaster& truth,
                                 const LabelMap& labels,
                                 const HeightComparisonOptions& options = {});

/// The usual substitute for relief: the picture's brightness (Rec. 709 luma), 0 to 1.
FloatRaster brightness_as_height(const Photo& photo);

}  // namespace scree::meshing
