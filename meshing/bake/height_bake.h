#pragma once

#include "vision/image_io.h"
#include "vision/rock_data.h"

namespace scree::meshing {

/// Displacement map of the rocks of a photograph, by the closed form
/// (`rocks-and-deformer.md` part E).
///
/// The map has the photograph's size and the value at a pixel is the height in metres, at the
/// pixel's centre, of the highest rock above the plane through the rocks' equators; bare ground
/// is 0. Nothing is normalised.
/// @pre   Centres and depths are finite, radii positive, depths not negative.
/// @post  Heights lie in [0, greatest depth * scale_of(rocks)]; `metres_per_pixel` is
///        scale_of(rocks).
/// @throw InvalidInput  a rock breaks the precondition (named by its index), or the picture has no
///        pixels or more than 200 million.
vision::HeightImage bake_displacement(const vision::RockSet& rocks);

}  // namespace scree::meshing
