#pragma once

#include <algorithm>
#include <cmath>

// The arithmetic of the sound scheme on one cell or one face between two cells, in float. The
// plain step and the tiled one both call it, and the compiler vectorises loops over it.
namespace scree::terrain {

/// A multiple of `quantum`, a power of two, that is not above `amount` and less than two quanta
/// below; 0 for negative amounts.
///
/// Every volume that changes cells is such a multiple, so displacements are too, and sums of them
/// are exact in float as long as they stay below 2^24 quanta: what one cell loses another gains to
/// the last bit, in any order of summation. Rounding down keeps the maximum principle. From 2^23
/// quanta on the result is only near `amount`.
inline float quantised(float amount, float quantum) {
    const float shift = quantum * 8388608.0F;  // 2^23: floats from here on are quanta apart
    return std::max(amount + (shift - 0.5F * quantum), shift) - shift;
}

/// Arc tangent of the square root of z in [0, 1], over that root; to 1.4e-7 rad.
inline float arctangent_series(float z) {
    float sum = -0.00455979199F;  // interpolates at the Chebyshev nodes of [0, 1]
    sum = sum * z + 0.0237805186F;
    sum = sum * z - 0.0588297531F;
    sum = sum * z + 0.0986886546F;
    sum = sum * z - 0.140032902F;
    sum = sum * z + 0.199669618F;
    sum = sum * z - 0.333318127F;
    return sum * z + 0.999999882F;
}

/// Arc tangent without branches or calls, so that loops over it vectorise.
/// @pre  tangent >= 0.
inline float arctangent(float tangent) {
    const float x = std::min(tangent, 1.0F / std::max(tangent, 1.0F));  // it or its inverse
    const float angle = arctangent_series(x * x) * x;
    return tangent > 1.0F ? 1.57079633F - angle : angle;
}

/// D of a face (`rocks-and-deformer.md` C.8): the harmonic mean; 0 if either is 0.
inline float face_diffusion(float a, float b) {
    const float sum = a + b;
    return sum > 0.0F ? 2.0F * a * b / sum : 0.0F;
}

/// Slide through a face by the slope in excess of what holds (C.8, `Excess`), metres of height,
/// unsigned, 0 where the slope holds; quantised().
///
/// What holds and the rounding are one number, which the loops keep where it is the same on every
/// face. That number is itself rounded to halves of a quantum, hence the quarter.
/// @param difference  Height difference across the face.
/// @param holds       Difference that stays: tan(repose) of the higher cell times the cell size, or
///                    the size of the base's difference if its own steepness holds (C.7).
/// @param diffusion   Of the face, times the time step.
inline float excess_slide(float difference, float holds, float diffusion, float quantum) {
    const float shift = quantum * 8388608.0F;  // as in quantised()
    const float least = (shift - 0.5F * quantum) - (holds * diffusion + 0.25F * quantum);
    return std::max(std::fabs(difference) * diffusion + least, shift) - shift;
}

/// Slide through a face by the slope, weighted by its angle above repose (4.4 on faces, C.8
/// `Weight`; with `gain` 4 `Gain`), metres of height, unsigned.
/// @param repose         Of the higher cell, radians.
/// @param per_cell_size  1 / cell size.
inline float weighted_slide(float difference, float base_difference, float repose, float diffusion,
                            float per_cell_size, float gain) {
    const float size = std::fabs(difference);
    const float angle = arctangent(size * per_cell_size);
    const float holds = std::max(repose, arctangent(std::fabs(base_difference) * per_cell_size));
    const float room = std::max(1.57079633F - holds, 1e-6F);
    const float weight = std::min(std::max(gain * (angle - holds) / room, 0.0F), 1.0F);
    return diffusion * (weight * size);
}

/// Share of what the load would push out of a cell that the limiter lets go (C.9).
/// @param room     Soil between the cell's height and the underside of the load, metres.
/// @param outflow  Sum of the unlimited outgoing pushes, metres.
inline float limited_share(float room, float outflow) {
    return outflow > room ? room / outflow : 1.0F;
}

}  // namespace scree::terrain
