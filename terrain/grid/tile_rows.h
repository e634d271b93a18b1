#pragma once

#include "terrain/grid/face_flux.h"
#include "terrain/grid/tile_kernel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

// Loops over one row of a patch or tile, each over a constant number of columns. They are inlined
// into the functions that are built for several machines, which is why they lie in a header.
namespace scree::terrain {

/// One value per column, with memory before the first and after the last; those alone are set.
class Row {
public:
    Row() {
        std::fill_n(floats_, kBefore, 0.0F);
        std::fill_n(at(kPatchWidth), kAfter, 0.0F);
    }

    float* at(int column) { return floats_ + kBefore + column; }
    const float* at(int column) const { return floats_ + kBefore + column; }
    void clear() { std::fill_n(at(0), kPatchWidth, 0.0F); }

private:
    static constexpr int kBefore = 16;
    static constexpr int kAfter = 16;
    alignas(64) float floats_[kBefore + kPatchWidth + kAfter];
};

/// This row's and the next one's, which changes places with it.
struct RowPair {
    Row rows[2];
    Row* here = &rows[0];
    Row* next = &rows[1];

    void advance() { std::swap(here, next); }
};

/// Ask for the heights of a row to come: rows of the base are far apart in memory, where no machine
/// looks ahead by itself.
[[gnu::always_inline]] inline void fetch_row(const float* row, int n) {
#if defined(__GNUC__)
    constexpr int kLine = 16;  // floats
    for (int x = 0; x < n; x += kLine)
        __builtin_prefetch(row + x, 0, 2);
#else
    (void)row;
    (void)n;
#endif
}

/// The flux from cell 1 into cell 0 (C.8).
template <bool kWeighted>
[[gnu::always_inline]] inline float slide_flux(float u0, float u1, float b0, float b1,
                                               float threshold0, float threshold1, float diffusion,
                                               const SoundRule& rule, std::uint32_t keep) {
    const float base_difference = b1 - b0;
    const float difference = base_difference + (u1 - u0);
    const float threshold = difference > 0.0F ? threshold1 : threshold0;
    const float holds = std::bit_cast<float>(std::bit_cast<std::uint32_t>(base_difference) & keep);
    float amount;
    if constexpr (kWeighted)
        amount =
            weighted_slide(difference, holds, threshold, diffusion, rule.per_cell_size, rule.gain);
    else
        amount = excess_slide(difference, holds, threshold, diffusion);
    return std::copysign(quantised(amount, rule.quantum), difference);
}

inline std::uint32_t keep_bits(const SoundRule& rule) {
    return rule.keep_base ? ~0U : 0U;
}

/// Two rows of cells with faces between them.
struct Between {
    const float *u0, *u1, *base0, *base1;
    const float *threshold0, *threshold1, *diffusion;  // read if the soil is not uniform
};

template <bool kWeighted, bool kPlanes, int kCount>
[[gnu::always_inline]] inline void slide_row(const Between& between, const PatchSoil& soil,
                                             const SoundRule& rule, float* __restrict flux) {
    const Between b = between;
    const SoundRule r = rule;
    const std::uint32_t keep = keep_bits(r);
    const float threshold = soil.threshold;
    const float diffusion = soil.diffusion;
    for (int x = 0; x < kCount; ++x)
        flux[x] = slide_flux<kWeighted>(
            b.u0[x], b.u1[x], b.base0[x], b.base1[x], kPlanes ? b.threshold0[x] : threshold,
            kPlanes ? b.threshold1[x] : threshold, kPlanes ? b.diffusion[x] : diffusion, r, keep);
}

/// Take the loads' push (positive from cell 0 to cell 1) off the flux from cell 1 to cell 0.
[[gnu::always_inline]] inline void push_row(const float* push, const float* share0,
                                            const float* share1, float quantum,
                                            float* __restrict flux) {
    for (int x = 0; x < kPatchWidth; ++x) {
        const float s0 = share0[x];
        const float s1 = share1[x];
        const float share = push[x] > 0.0F ? s0 : s1;
        const float amount = quantised(std::fabs(push[x]) * share, quantum);
        flux[x] -= std::copysign(amount, push[x]);
    }
}

/// What the limiter lets go (C.9), and what is pressed together first, in patch row y.
[[gnu::always_inline]] inline void share_row(const Patch& patch, int y, float quantum,
                                             float* __restrict share, float* __restrict compacted) {
    const float* u = patch.u + y * kPatchWidth;
    const float* base = patch.base.row(y);
    const float* underside = patch.load.underside.row(y);
    const float* outflow = patch.load.outflow.row(y);
    if (patch.load.compaction.values) {
        const float* compaction = patch.load.compaction.row(y);
        for (int x = 0; x < kPatchWidth; ++x) {
            const float penetration = std::max((base[x] + u[x]) - underside[x], 0.0F);
            compacted[x] = quantised(compaction[x] * penetration, quantum);
            share[x] = limited_share(penetration - compacted[x], outflow[x]);
        }
        return;
    }
    for (int x = 0; x < kPatchWidth; ++x)
        share[x] = limited_share(std::max((base[x] + u[x]) - underside[x], 0.0F), outflow[x]);
}

/// Fluxes through the four faces of a row of cells, and what is pressed together in them.
struct RowFlux {
    const float *left, *above, *below, *compacted;
};

/// New displacements of a row; returns bits that are 0 if all stay.
template <int kCount, bool kLoad, bool kNote>
[[gnu::always_inline]] inline std::uint32_t update_row(const RowFlux& fluxes, const float* u,
                                                       float* out,
                                                       std::uint32_t* __restrict columns) {
    const RowFlux f = fluxes;
    std::uint32_t changed = 0;
#pragma GCC ivdep
    for (int x = 0; x < kCount; ++x) {
        float gain = (f.left[x + 1] - f.left[x]) + (f.below[x] - f.above[x]);
        if constexpr (kLoad)
            gain -= f.compacted[x];
        const float before = u[x];
        const float after = before + gain;
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

/// The fluxes below a row and its new displacements in one loop; otherwise as update_row().
/// @param between  The cells of the row and those below them.
template <bool kWeighted, bool kPlanes, int kCount, bool kNote>
[[gnu::always_inline]] inline std::uint32_t slide_and_update(const Between& between,
                                                             const PatchSoil& soil,
                                                             const SoundRule& rule,
                                                             const RowFlux& fluxes, float* below,
                                                             float* out, std::uint32_t* columns) {
    const Between b = between;
    const SoundRule r = rule;
    const RowFlux f = fluxes;
    const std::uint32_t keep = keep_bits(r);
    const float threshold = soil.threshold;
    const float diffusion = soil.diffusion;
    std::uint32_t changed = 0;
#pragma GCC ivdep
    for (int x = 0; x < kCount; ++x) {
        const float before = b.u0[x];
        const float flux = slide_flux<kWeighted>(
            before, b.u1[x], b.base0[x], b.base1[x], kPlanes ? b.threshold0[x] : threshold,
            kPlanes ? b.threshold1[x] : threshold, kPlanes ? b.diffusion[x] : diffusion, r, keep);
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

inline void note_row(PatchChange& change, int row, std::uint32_t changed) {
    if (changed == 0)
        return;
    change.first_row = std::min(change.first_row, row);
    change.last_row = row;
}

}  // namespace scree::terrain
