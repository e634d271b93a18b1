#pragma once

#include "terrain/grid/face_flux.h"
#include "terrain/grid/tile_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

// Slides over one row; see tile_rows.h.
namespace scree::terrain {

/// The flux from cell 1 into cell 0 (C.8).
/// @tparam kKeep  As SoundRule::keep_base.
template <bool kWeighted, bool kKeep>
[[gnu::always_inline]] inline float slide_flux(float u0, float u1, float b0, float b1,
                                               float threshold0, float threshold1, float diffusion,
                                               const SoundRule& rule) {
    const float base_difference = b1 - b0;
    const float difference = base_difference + (u1 - u0);
    const float threshold = difference > 0.0F ? threshold1 : threshold0;
    const float held = kKeep ? std::fabs(base_difference) : 0.0F;
    float quanta;
    if constexpr (kWeighted)
        quanta = quantised(
            weighted_slide(difference, held, threshold, diffusion, rule.per_cell_size, rule.gain),
            rule.quantum);
    else
        quanta = excess_slide(difference, kKeep ? std::max(threshold, held) : threshold, diffusion,
                              rule.quantum);
    return std::copysign(quanta, difference);
}

/// Two rows of cells with faces between them.
struct Between {
    const float *u0, *u1, *base0, *base1;
    const float *threshold0, *threshold1, *diffusion;  // read if the soil is not uniform
};

template <bool kWeighted, bool kPlanes, bool kKeep, int kCount>
[[gnu::always_inline]] inline void slide_row(const Between& between, const PatchSoil& soil,
                                             const SoundRule& rule, float* __restrict flux) {
    const Between b = between;
    const SoundRule r = rule;
    const float threshold = soil.threshold;
    const float diffusion = soil.diffusion;
    for (int x = 0; x < kCount; ++x)
        flux[x] = slide_flux<kWeighted, kKeep>(
            b.u0[x], b.u1[x], b.base0[x], b.base1[x], kPlanes ? b.threshold0[x] : threshold,
            kPlanes ? b.threshold1[x] : threshold, kPlanes ? b.diffusion[x] : diffusion, r);
}

/// The fluxes below a row and its new displacements in one loop; otherwise as update_row().
/// @param between  The cells of the row and those below them.
template <bool kWeighted, bool kPlanes, bool kKeep, int kCount, bool kNote>
[[gnu::always_inline]] inline std::uint32_t slide_and_update(const Between& between,
                                                             const PatchSoil& soil,
                                                             const SoundRule& rule,
                                                             const RowFlux& fluxes, float* below,
                                                             float* out, std::uint32_t* columns) {
    const Between b = between;
    const SoundRule r = rule;
    const RowFlux f = fluxes;
    const float threshold = soil.threshold;
    const float diffusion = soil.diffusion;
    std::uint32_t changed = 0;
#pragma GCC ivdep
    for (int x = 0; x < kCount; ++x) {
        const float before = b.u0[x];
        const float flux = slide_flux<kWeighted, kKeep>(
            before, b.u1[x], b.base0[x], b.base1[x], kPlanes ? b.threshold0[x] : threshold,
            kPlanes ? b.threshold1[x] : threshold, kPlanes ? b.diffusion[x] : diffusion, r);
        below[x] = flux;
        const float after = before + ((f.left[x + 1] - f.left[x]) + (flux - f.above[x]));
        out[x] = after;
        if constexpr (kNote) {
            const std::uint32_t bits =
                std::bit_cast<std::uint32_t>(before) ^ std::bit_cast<std::uint32_t>(after);
            changed |= bits;
            columns[x] |= bits;
        }
    }
    return changed;
}

}  // namespace scree::terrain
