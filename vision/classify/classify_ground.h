#pragma once

#include "base/options.h"
#include "vision/classify/ground_model.h"

namespace scree::vision {

/// How a photograph of ground is cut into regions of one class.
struct GroundOptions {
    int max_side = 640;             ///< Larger pictures are worked on at this size.
    SuperpixelOptions superpixels;  ///< The pieces that are classified.
    double smoothing = 5.0;         ///< How much a piece takes from its neighbours; 0: nothing.
    int smoothing_rounds = 10;      ///< Most rounds of it.
    double slope_weight = 0.3;      ///< Evidence in a degree of slope beyond what a class can hold.
};

template <class Visitor>
void describe(GroundOptions& o, Visitor&& field) {
    field("max-side", o.max_side,
          {.min = 64, .max = 8192, .unit = "px", .help = "larger pictures are worked on at this"});
    describe(o.superpixels, field);
    field("smoothing", o.smoothing,
          {.min = 0, .max = 100, .help = "how much a piece takes from its neighbours"});
    field("smoothing-rounds", o.smoothing_rounds,
          {.min = 0, .max = 100, .help = "most rounds of smoothing"});
    field("slope-weight", o.slope_weight,
          {.min = 0, .max = 10, .help = "evidence in a degree of slope too steep for a class"});
}

/// Classes of a photograph's pixels.
struct GroundRegions {
    Raster<std::uint8_t> classes;                 ///< GroundClass, of the photograph's size.
    FloatRaster confidence;                       ///< Probability of that class before smoothing.
    std::array<double, kGroundClasses> shares{};  ///< Of the area.
    int pieces = 0;                               ///< Superpixels.
};

/// Classify a photograph taken from above.
///
/// Superpixels, features of colour and texture, a logistic regression on them, then iterated
/// conditional modes: a piece takes the class that its own evidence and the length of border with
/// neighbours of that class favour most. The same bytes for any number of threads.
///
/// @param slope  Degrees, of the photograph's size, or empty: ground steeper than a class can lie
///               speaks against it (`rocks-and-deformer.md` D.7).
/// @throw InvalidOption  a value is out of range.
/// @throw InvalidInput   the photograph is empty, the slope has another size or no numbers.
GroundRegions classify_ground(const Photo& photo, const GroundOptions& options = {},
                              const FloatRaster& slope = {},
                              const GroundModel& model = shipped_ground_model());

/// The photograph with regions tinted and their borders drawn; colours by class.
Photo draw_regions(const Photo& photo, const Raster<std::uint8_t>& classes);

}  // namespace scree::vision
