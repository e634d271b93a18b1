#pragma once

#include "base/raster.h"
#include "vision/data/grain_size.h"

namespace scree::vision {

struct SizePlotOptions {
    int width = 900;       ///< px
    int height = 600;      ///< px
    bool by_area = false;  ///< Mark the percentiles by area instead of those by number.
};

template <class Visitor>
void describe(SizePlotOptions& o, Visitor&& field) {
    field("plot-width", o.width,
          {.min = 320, .max = 8192, .unit = "px", .help = "width of the plot"});
    field("plot-height", o.height,
          {.min = 240, .max = 8192, .unit = "px", .help = "height of the plot"});
    field("by-area", o.by_area,
          {.min = 0, .max = 1, .help = "mark the percentiles by area, not by number"});
}

/// Plot cumulative grain-size curves: share that is finer, by number and by area, over the
/// diameter on a logarithmic axis, in millimetres where the scale is known, with D16, D50 and
/// D84 marked. Without rocks the axes are empty and say so.
/// @throw InvalidOption
Photo draw_size_plot(const GrainSizeCurve& curve, const SizePlotOptions& options = {});

}  // namespace scree::vision
