#pragma once

#include "base/raster.h"
#include "vision/classical/mlp.h"
#include "vision/edge_field.h"
#include "vision/learned/outline_network.h"

#include <array>
#include <span>
#include <vector>

namespace scree::vision {

/// Logits of boundary, inside and distance at one scale.
using LogitPlanes = std::array<FloatRaster, kFieldChannels>;

/// What the network says at every scale, finest first: every scale has half the size of the one
/// before it, rounded up.
struct LevelStack {
    std::vector<LogitPlanes> doubled;  ///< Of the picture at twice its size, brought to its own;
                                       ///< one or none.
    std::vector<LogitPlanes> levels;   ///< At 1, 1/2, 1/4 ...; at least one.
};

/// How the scales become one field: by a network, or as their mean.
struct FusionModel {
    bool reads_doubled = false;  ///< The picture at twice its size is a scale as well.
    int n_levels =
        3;  ///< Scales that are read, finest first; coarser ones serve as stand-ins only.
    Mlp network = {};  ///< 3 inputs a scale, logits cut at 8 either way; empty: the mean.
};

/// The model that the library was built with.
const FusionModel& shipped_fusion();

/// Read whether the doubled scale is read, the number of scales, then the network by read_mlp(); a
/// network without layers is written as the single number 0.
/// @throw InvalidInput  a number is missing, or the network has not 3 inputs a scale and 3 outputs.
FusionModel read_fusion(std::span<const double> numbers);

/// One field from all scales: at every pixel the logits of the scales, coarse ones enlarged
/// linearly, go through the model. Where a scale is missing its nearest coarser one, or the
/// coarsest there is, takes its place. Uses the planes up.
EdgeField fuse_levels(LevelStack&& stack, const FusionModel& model);

}  // namespace scree::vision
