#pragma once

#include "terrain/grid/face_flux.h"

#include <algorithm>
#include <cmath>

// The arithmetic of the published scheme on one cell and axis, in float; the plain step and the
// fast one both call it.
namespace scree::terrain {

/// D times the second difference: the first term of (4.9), metres.
inline float literal_diffusion(float before, float here, float after, float diffusion) {
    return diffusion * ((before + after) - 2.0F * here);
}

/// The force term of (4.9), metres.
/// @param scale  Sign, 1/2 and cell size.
inline float literal_push(float before, float after, float mobility, float scale) {
    return scale * (mobility * (after - before));
}

/// A term times its weight, (4.4) and (4.11): w d.
/// @param per_room  1 / (pi/2 - repose).
/// @param to_grid   From metres to the arc tangent's argument, steps^2 / cell size.
inline float literal_weighted(float term, float repose, float per_room, float to_grid,
                              bool clamp_weights) {
    const float size = std::fabs(term) * to_grid;
    const float angle = arctangent_of_root(size);
    float weight = (angle - repose) * per_room;
    if (clamp_weights)
        weight = std::min(std::max(weight, 0.0F), 1.0F);
    return weight * term;
}

inline float literal_room(float repose) {
    return 1.0F / std::max(1.57079633F - repose, 1e-6F);
}

}  // namespace scree::terrain
