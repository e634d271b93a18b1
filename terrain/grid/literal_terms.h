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

/// Arc tangent of the square root of a >= 0, to 5e-7 rad: what the angles of (4.11) are.
inline float arctangent_of_root(float a) {
    const float z = std::min(a, 1.0F / std::max(a, 1.0F));  // a or 1 / a
    float sum = 0.00764835393F;  // interpolates at the Chebyshev nodes of [0, 1]
    sum = sum * z - 0.0363604309F;
    sum = sum * z + 0.083126453F;
    sum = sum * z - 0.134478641F;
    sum = sum * z + 0.198720403F;
    sum = sum * z - 0.33325678F;
    sum = (sum * z + 0.999999226F) * std::sqrt(z);
    return a > 1.0F ? 1.57079633F - sum : sum;
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
/// @param to_grid  From metres to the arc tangent's argument, steps^2 / cell size.
inline float literal_product(float term_x, float term_z, const LiteralWeight& weight,
                             float to_grid) {
    return weight(arctangent_of_root(std::fabs(term_x) * to_grid)) * term_x +
           weight(arctangent_of_root(std::fabs(term_z) * to_grid)) * term_z;
}

inline float literal_room(float repose) {
    return 1.0F / std::max(1.57079633F - repose, 1e-6F);
}

}  // namespace scree::terrain
