#pragma once

#include "base/options.h"
#include "base/raster.h"
#include "vision/image_io.h"
#include "vision/rock_data.h"

namespace scree::meshing {

struct ReliefOptions {
    /// How far the photograph moves the surface: the height of a rock changes by this share where
    /// the relief signal is 1, and gaps reach six times this share of the rocks' median depth.
    /// 0 leaves the domes of bake_displacement() alone.
    double detail = 0.15;
};

template <class Visitor>
void describe(ReliefOptions& o, Visitor&& field) {
    field("detail", o.detail,
          {.min = 0,
           .max = 0.5,
           .help = "share of the rocks' depth by which the photograph moves the displacement map"});
}

/// What a photograph adds to its rocks; both have its size.
struct ReliefPlanes {
    const FloatRaster& signal;  ///< vision::relief_signal(), in [-1, 1].
    const LabelMap& labels;     ///< vision::paint_labels() of the rocks' outlines.
};

/// Displacement map of the rocks with the relief that the photograph shows.
///
/// Over a rock the height y of the dome becomes y (1 + detail (s - m)), where s is the signal and m
/// its mean over the rock's pixels weighted by y: on average a rock stays as high as it was, and
/// its border stays at 0. Elsewhere the height is -3 detail h (1 - s), h the median depth of all
/// rocks: gaps lie below the rocks' feet. Without rocks there is no scale, and the map is flat.
/// @pre   As bake_displacement().
/// @post  With detail 0 the bytes of bake_displacement().
/// @throw InvalidInput   as bake_displacement(); a plane has another size than the picture, the
///                       signal values outside [-1, 1], the labels one without a rock.
/// @throw InvalidOption  detail is out of its range.
vision::HeightImage bake_displacement(const vision::RockSet& rocks, const ReliefPlanes& planes,
                                      const ReliefOptions& options = {});

/// Median over the rocks of the radius of the disc of equal area, px; 0 without rocks. What
/// vision::relief_signal() asks for.
double typical_radius(const vision::RockSet& rocks);

}  // namespace scree::meshing
