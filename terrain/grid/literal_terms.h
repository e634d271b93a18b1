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

/// Arc sine of the square root of w in [0, 1/2], over that root; to 2.2e-7 rad.
inline float arcsine_series(float w) {
    float sum = 0.0999071056F;  // interpolates at the Chebyshev nodes of [0, 1/2]
    sum = sum * w - 0.0535424837F;
    sum = sum * w + 0.0601242776F;
    sum = sum * w + 0.0390137921F;
    sum = sum * w + 0.0754907417F;
    sum = sum * w + 0.166650979F;
    return sum * w + 1.00000008F;
}

/// What a term's weight is made of.
struct LiteralWeight {
    float repose = 0.0F;    ///< Radians.
    float per_room = 0.0F;  ///< 1 / (pi/2 - repose).
    bool clamp = false;     ///< To [0, 1].

    /// (4.4)
    float operator()(float angle) const {
        const float weight = (angle - repose) * per_room;
        return clamp ? std::min(std::max(weight, 0.0F), 1.0F) : weight;
    }
};

/// The scalar product w d of (4.6), the angles by (4.11).
///
/// With v = a / (1 + a) the angle atan(sqrt a) is asin(sqrt v), or pi/2 - asin(sqrt(1 - v)) for
/// a > 1: the two axes share one division.
/// @param to_grid  From metres to the arc tangent's argument, steps^2 / cell size.
inline float literal_product(float term_x, float term_z, const LiteralWeight& weight,
                             float to_grid) {
    constexpr float kGreatest = 1e18F;  // products stay finite
    const float a = std::min(std::fabs(term_x) * to_grid, kGreatest);
    const float b = std::min(std::fabs(term_z) * to_grid, kGreatest);
    const float a1 = 1.0F + a;
    const float b1 = 1.0F + b;
    const float both = 1.0F / (a1 * b1);
    const float v = (a > 1.0F ? 1.0F : a) * (b1 * both);
    const float w = (b > 1.0F ? 1.0F : b) * (a1 * both);
    const float angle_x = arcsine_series(v) * std::sqrt(v);
    const float angle_z = arcsine_series(w) * std::sqrt(w);
    return weight(a > 1.0F ? 1.57079633F - angle_x : angle_x) * term_x +
           weight(b > 1.0F ? 1.57079633F - angle_z : angle_z) * term_z;
}

inline float literal_room(float repose) {
    return 1.0F / std::max(1.57079633F - repose, 1e-6F);
}

}  // namespace scree::terrain
