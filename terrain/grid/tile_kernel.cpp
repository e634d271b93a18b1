// One iteration on a patch, row after row: the flux through the faces below a row is made before
// the row is replaced and kept for the next one, so a patch is stepped in place and stays in cache
// over all iterations of a pass. Every loop runs over a constant number of columns.
#include "terrain/grid/tile_kernel.h"

#include "base/simd.h"
#include "terrain/grid/face_flux.h"

#include <bit>
#include <cstring>
#include <utility>

namespace scree::terrain {
namespace {

/// One value per column, and one more for the face after the last.
struct alignas(64) Row {
    float values[kPatchWidth + 16] = {};
};

/// Rows that one iteration carries along.
struct Rows {
    Row flux_x;                     ///< Flux through the faces left of the cells.
    Row above, below;               ///< Flux through the faces above and below the cells.
    Row share, next_share;          ///< What the limiter lets go, of this row and the one below.
    Row compacted, next_compacted;  ///< What is pressed together.
};

struct Arguments {
    const Patch& patch;
    const SoundRule& rule;
    int begin, end;
    float* out;
    PatchChange& change;
};

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

/// Fluxes through the faces between a row of cells and the one `step` floats before it.
template <bool kWeighted, bool kPlanes>
[[gnu::always_inline]] inline void slide_row(const float* u0, const float* u1, const float* b0,
                                             const float* b1, const float* threshold0,
                                             const float* threshold1, const float* diffusion,
                                             const PatchSoil& soil, const SoundRule& rule,
                                             float* __restrict flux) {
    const SoundRule local = rule;
    const std::uint32_t keep = rule.keep_base ? ~0U : 0U;
    const float threshold = soil.threshold;
    const float uniform = soil.diffusion;
    for (int x = 0; x < kPatchWidth; ++x)
        flux[x] = slide_flux<kWeighted>(
            u0[x], u1[x], b0[x], b1[x], kPlanes ? threshold0[x] : threshold,
            kPlanes ? threshold1[x] : threshold, kPlanes ? diffusion[x] : uniform, local, keep);
}

/// Take the loads' push (positive from cell 0 to cell 1) off the flux from cell 1 to cell 0.
[[gnu::always_inline]] inline void push_row(const float* push, const float* share0,
                                            const float* share1, float quantum,
                                            float* __restrict flux) {
    for (int x = 0; x < kPatchWidth; ++x) {
        const float share = push[x] > 0.0F ? share0[x] : share1[x];
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

/// Fluxes through the faces above patch row y.
template <bool kWeighted, bool kPlanes, bool kLoad>
[[gnu::always_inline]] inline void faces_above(const Arguments& a, int y, const Row& share,
                                               const Row& next_share, Row& flux) {
    const Patch& patch = a.patch;
    const float* u = patch.u + y * kPatchWidth;
    const float* threshold = kPlanes ? patch.soil.threshold_plane.row(y) : nullptr;
    const float* threshold_above = kPlanes ? patch.soil.threshold_plane.row(y - 1) : nullptr;
    slide_row<kWeighted, kPlanes>(
        u - kPatchWidth, u, patch.base.row(y - 1), patch.base.row(y), threshold_above, threshold,
        kPlanes ? patch.soil.diffusion_z.row(y) : nullptr, patch.soil, a.rule, flux.values);
    if constexpr (kLoad)
        push_row(patch.load.push_z.row(y), share.values, next_share.values, a.rule.quantum,
                 flux.values);
}

/// Fluxes through the faces left of the cells of patch row y.
template <bool kWeighted, bool kPlanes, bool kLoad>
[[gnu::always_inline]] inline void faces_left(const Arguments& a, int y, Rows& rows) {
    const Patch& patch = a.patch;
    const float* u = patch.u + y * kPatchWidth;
    const float* base = patch.base.row(y);
    const float* threshold = kPlanes ? patch.soil.threshold_plane.row(y) : nullptr;
    slide_row<kWeighted, kPlanes>(u - 1, u, base - 1, base, kPlanes ? threshold - 1 : nullptr,
                                  threshold, kPlanes ? patch.soil.diffusion_x.row(y) : nullptr,
                                  patch.soil, a.rule, rows.flux_x.values);
    if constexpr (kLoad) {
        Row before;  // the shares, one cell further left
        std::memcpy(before.values + 1, rows.share.values, sizeof(float) * kPatchWidth);
        push_row(patch.load.push_x.row(y), before.values, rows.share.values, a.rule.quantum,
                 rows.flux_x.values);
    }
}

/// Nothing flows through the rim of the ground, or its cells stay as they are (4.7).
[[gnu::always_inline]] inline void hold_rim_columns(const Arguments& a, Rows& rows) {
    float* flux = rows.flux_x.values;
    const int left = a.patch.first_column;
    const int right = a.patch.columns_end;
    const bool zero = a.rule.border == Border::Zero;
    if (left >= 0)
        flux[left] =
            zero ? flux[left + 1] + (rows.below.values[left] - rows.above.values[left]) : 0.0F;
    if (right <= kPatchWidth)
        flux[right] =
            zero ? flux[right - 1] - (rows.below.values[right - 1] - rows.above.values[right - 1])
                 : 0.0F;
}

/// New displacements of columns [kFirst, kFirst + kCount); returns bits that are 0 if all stay.
template <int kFirst, int kCount, bool kLoad, bool kColumns>
[[gnu::always_inline]] inline std::uint32_t update_row(const Rows& rows, const float* u, float* out,
                                                       std::uint32_t* __restrict columns) {
    const float* flux = rows.flux_x.values + kFirst;
    const float* above = rows.above.values + kFirst;
    const float* below = rows.below.values + kFirst;
    const float* compacted = rows.compacted.values + kFirst;
    std::uint32_t changed = 0;
#pragma GCC ivdep
    for (int x = 0; x < kCount; ++x) {
        float gain = (flux[x + 1] - flux[x]) + (below[x] - above[x]);
        if constexpr (kLoad)
            gain -= compacted[x];
        const float before = u[x];
        const float after = before + gain;
        out[x] = after;
        const std::uint32_t bits =
            std::bit_cast<std::uint32_t>(before) ^ std::bit_cast<std::uint32_t>(after);
        changed |= bits;
        if constexpr (kColumns)
            columns[x] |= bits;
    }
    return changed;
}

double tile_sum(const float* row) {
    double sum = 0.0;
    for (int x = kHalo; x < kHalo + kTileWidth; ++x)
        sum += row[x];
    return sum;
}

template <bool kWeighted, bool kPlanes, bool kLoad>
[[gnu::always_inline]] inline void step_rows(const Arguments& a) {
    const Patch& patch = a.patch;
    Rows rows;
    if constexpr (kLoad) {
        if (a.begin > patch.first_row)
            share_row(patch, a.begin - 1, a.rule.quantum, rows.share.values, rows.compacted.values);
        share_row(patch, a.begin, a.rule.quantum, rows.next_share.values,
                  rows.next_compacted.values);
    }
    if (a.begin > patch.first_row)
        faces_above<kWeighted, kPlanes, kLoad>(a, a.begin, rows.share, rows.next_share, rows.above);
    for (int y = a.begin; y < a.end; ++y) {
        const bool has_below = y + 1 < patch.rows_end;
        if constexpr (kLoad) {
            rows.share = rows.next_share;
            rows.compacted = rows.next_compacted;
            if (has_below)
                share_row(patch, y + 1, a.rule.quantum, rows.next_share.values,
                          rows.next_compacted.values);
        }
        if (has_below)
            faces_above<kWeighted, kPlanes, kLoad>(a, y + 1, rows.share, rows.next_share,
                                                   rows.below);
        else
            rows.below = Row{};
        faces_left<kWeighted, kPlanes, kLoad>(a, y, rows);
        hold_rim_columns(a, rows);
        float* u = patch.u + y * kPatchWidth;
        const int tile_row = y - kHalo;
        if (a.out) {
            const std::uint32_t changed = update_row<kHalo, kTileWidth, kLoad, true>(
                rows, u + kHalo, a.out + tile_row * kTileWidth, a.change.columns);
            if (changed) {
                a.change.first_row = std::min(a.change.first_row, tile_row);
                a.change.last_row = tile_row;
            }
        } else {
            update_row<0, kPatchWidth, kLoad, false>(rows, u, u, nullptr);
        }
        if (kLoad && patch.load.compaction.values && tile_row >= 0 && tile_row < kTileHeight)
            a.change.compacted += tile_sum(rows.compacted.values);
        std::swap(rows.above, rows.below);
    }
}

SCREE_MULTIVERSION void excess_uniform(const Arguments& a) {
    step_rows<false, false, false>(a);
}
SCREE_MULTIVERSION void excess_planes(const Arguments& a) {
    step_rows<false, true, false>(a);
}
SCREE_MULTIVERSION void excess_load(const Arguments& a) {
    step_rows<false, true, true>(a);
}
SCREE_MULTIVERSION void weighted_uniform(const Arguments& a) {
    step_rows<true, false, false>(a);
}
SCREE_MULTIVERSION void weighted_planes(const Arguments& a) {
    step_rows<true, true, false>(a);
}
SCREE_MULTIVERSION void weighted_load(const Arguments& a) {
    step_rows<true, true, true>(a);
}

}  // namespace

void step_patch(const Patch& patch, const SoundRule& rule, int begin, int end, float* out,
                PatchChange& change) {
    const Arguments arguments{patch, rule, begin, end, out, change};
    const bool weighted = rule.slide != Slide::Excess;
    if (patch.load.underside.values)
        weighted ? weighted_load(arguments) : excess_load(arguments);
    else if (patch.soil.uniform)
        weighted ? weighted_uniform(arguments) : excess_uniform(arguments);
    else
        weighted ? weighted_planes(arguments) : excess_planes(arguments);
}

}  // namespace scree::terrain
