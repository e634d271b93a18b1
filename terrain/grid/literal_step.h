#pragma once

#include "terrain/grid/deformer.h"

namespace scree::terrain {

/// Numbers and switches of the published scheme (`rocks-and-deformer.md` C.3 to C.6).
struct LiteralRule {
    LiteralTerms terms = LiteralTerms::SingleTerm;
    Border border = Border::Zero;
    bool clamp_weights = false;  ///< C6.4: (4.4) goes negative below repose.
    bool plus_sign = false;      ///< C6.1: the force term's sign as printed in (4.9).
    bool half = true;            ///< C6.2: the factor 1/2 of (4.9), which the listing lacks.
    float steps = 1.0F;          ///< C6.3: multiplier in the listing's arc tangent; 1 in (4.11).
    float time_step = 1.0F;
    float cell_size = 1.0F;
};

LiteralRule literal_rule(const Heightfield& base, const DeformerOptions& options);

/// One iteration of the published scheme, (4.6) and (4.9) to (4.13), defects included: base and
/// displacement move together as one height, terms are of curvature instead of slope, and volume
/// is not kept. Every cell reads the old heights (C6.7).
///
/// Heights outside the ground are those of its rim, forces there are zero. The loads' undersides
/// mean nothing here: the published scheme has no limiter.
///
/// @param base     Rim heights that Border::Zero holds.
/// @param soil     Of every cell.
/// @param heights  Base plus displacement, metres.
FloatRaster literal_step(const FloatRaster& base, const SoilTile& soil, std::span<const Load> loads,
                         const FloatRaster& heights, const LiteralRule& rule);

/// Some iterations as the author's compute stage runs them (C.5): groups of 16 x 16 cells load
/// their cells and a halo of one cell, and the halo keeps its first values over all iterations
/// (C6.7). Within a group every cell reads the old heights.
FloatRaster literal_step_tiled(const FloatRaster& base, const SoilTile& soil,
                               std::span<const Load> loads, const FloatRaster& heights,
                               const LiteralRule& rule, int iterations);

}  // namespace scree::terrain
