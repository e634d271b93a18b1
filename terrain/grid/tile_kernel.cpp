// Iterations on a patch, row after row and in place: the flux through the faces below a row is made
// before the row is replaced, and kept for the next one. An iteration follows the one before it one
// row behind, so the few rows between the first and the last of them stay in the innermost cache.
#include "terrain/grid/tile_kernel.h"

#include "base/simd.h"
#include "terrain/grid/tile_push.h"
#include "terrain/grid/tile_rows.h"
#include "terrain/grid/tile_slide.h"

#include <array>
#include <cstring>
#include <type_traits>

namespace scree::terrain {
namespace {

constexpr int kRowsAhead = 4;

struct Arguments {
    const Patch& patch;
    const SoundRule& rule;
    const PatchSteps& steps;
    float* out;
    PatchChange& change;
};

/// One of the iterations: its rows, and what it carries from row to row.
struct Level {
    int begin = 0;
    int end = 0;
    bool last = false;
    RowPair flux_z;  ///< Above and below the row.
};

/// What a level carries along under a load.
struct LoadLevel : Level {
    RowPair share;      ///< Of the row and the next.
    RowPair compacted;  ///< Of the row and the next.
};

template <bool kLoad>
using LevelOf = std::conditional_t<kLoad, LoadLevel, Level>;

/// Patch row y and the one above it, from column x on.
[[gnu::always_inline]] inline Between rows_above(const Patch& patch, int y, int x) {
    const float* u = patch.u + y * kPatchWidth + x;
    const PatchPlane& threshold = patch.soil.threshold_plane;
    return {u - kPatchWidth,
            u,
            patch.base.row(y - 1) + x,
            patch.base.row(y) + x,
            threshold.row(y - 1) + x,
            threshold.row(y) + x,
            patch.soil.diffusion_z.row(y) + x};
}

/// The cells of patch row y and those left of them.
[[gnu::always_inline]] inline Between cells_left(const Patch& patch, int y) {
    const float* u = patch.u + y * kPatchWidth;
    const float* base = patch.base.row(y);
    const float* threshold = patch.soil.threshold_plane.row(y);
    return {u - 1, u, base - 1, base, threshold - 1, threshold, patch.soil.diffusion_x.row(y)};
}

/// Nothing flows through the rim of the ground, or its cells stay as they are (4.7).
[[gnu::always_inline]] inline void hold_rim_columns(const Arguments& a, const float* above,
                                                    const float* below, float* flux) {
    const int left = a.patch.first_column;
    const int right = a.patch.columns_end;
    const bool zero = a.rule.border == Border::Zero;
    if (left >= 0)
        flux[left] = zero ? flux[left + 1] + (below[left] - above[left]) : 0.0F;
    if (right <= kPatchWidth)
        flux[right] = zero ? flux[right - 1] - (below[right - 1] - above[right - 1]) : 0.0F;
}

/// Fluxes through the faces above row y, the level's next row.
template <bool kWeighted, bool kPlanes, bool kKeep, bool kLoad>
[[gnu::always_inline]] inline void faces_above(const Arguments& a, const LevelOf<kLoad>& level,
                                               int y, float* flux) {
    slide_row<kWeighted, kPlanes, kKeep, kPatchWidth>(rows_above(a.patch, y, 0), a.patch.soil,
                                                      a.rule, flux);
    if constexpr (kLoad)
        push_row(a.patch.load.push_z.row(y), level.share.here->at(0), level.share.next->at(0),
                 a.rule.quantum, flux);
}

template <bool kWeighted, bool kPlanes, bool kKeep, bool kLoad>
[[gnu::always_inline]] inline void begin_level(const Arguments& a, LevelOf<kLoad>& level) {
    const bool has_above = level.begin > a.patch.first_row;
    const float quantum = a.rule.quantum;
    if constexpr (kLoad) {
        level.compacted.here->clear();  // stays if nothing is pressed together
        level.compacted.next->clear();
        if (has_above)
            share_row(a.patch, level.begin - 1, quantum, level.share.here->at(0),
                      level.compacted.here->at(0));
        share_row(a.patch, level.begin, quantum, level.share.next->at(0),
                  level.compacted.next->at(0));
    }
    if (has_above)
        faces_above<kWeighted, kPlanes, kKeep, kLoad>(a, level, level.begin,
                                                      level.flux_z.here->at(0));
    else
        level.flux_z.here->clear();
}

/// A row whose rim needs no care and which no load presses: two loops.
template <bool kWeighted, bool kPlanes, bool kKeep>
[[gnu::always_inline]] inline void slide_level_row(const Arguments& a, Level& level, int y,
                                                   const Row& flux_x) {
    const PatchSoil& soil = a.patch.soil;
    const RowPair& z = level.flux_z;
    if (level.last)
        note_row(a.change, y - kHalo,
                 slide_and_update<kWeighted, kPlanes, kKeep, kTileWidth, true>(
                     rows_above(a.patch, y + 1, kHalo), soil, a.rule,
                     {flux_x.at(kHalo), z.here->at(kHalo), nullptr, nullptr}, z.next->at(kHalo),
                     a.out + (y - kHalo) * kTileWidth, a.change.columns));
    else
        slide_and_update<kWeighted, kPlanes, kKeep, kPatchWidth, false>(
            rows_above(a.patch, y + 1, 0), soil, a.rule,
            {flux_x.at(0), z.here->at(0), nullptr, nullptr}, z.next->at(0),
            a.patch.u + y * kPatchWidth, nullptr);
}

template <bool kLoad>
[[gnu::always_inline]] inline void update_level_row(const Arguments& a, const LevelOf<kLoad>& level,
                                                    int y, const Row& flux_x) {
    float* u = a.patch.u + y * kPatchWidth;
    const auto fluxes = [&](int x) {
        RowFlux flux{flux_x.at(x), level.flux_z.here->at(x), level.flux_z.next->at(x), nullptr};
        if constexpr (kLoad)
            flux.compacted = level.compacted.here->at(x);
        return flux;
    };
    if (level.last)
        note_row(a.change, y - kHalo,
                 update_row<kTileWidth, kLoad, true>(
                     fluxes(kHalo), u + kHalo, a.out + (y - kHalo) * kTileWidth, a.change.columns));
    else
        update_row<kPatchWidth, kLoad, false>(fluxes(0), u, u, nullptr);
}

double tile_sum(const float* row) {
    double sum = 0.0;
    for (int x = kHalo; x < kHalo + kTileWidth; ++x)
        sum += double{row[x]};
    return sum;
}

template <bool kWeighted, bool kPlanes, bool kKeep, bool kLoad>
[[gnu::always_inline]] inline void step_level_row(const Arguments& a, LevelOf<kLoad>& level, int y,
                                                  Row& flux_x) {
    const Patch& patch = a.patch;
    const bool has_below = y + 1 < patch.rows_end;
    if constexpr (kLoad) {
        level.share.advance();
        level.compacted.advance();
        if (has_below)
            share_row(patch, y + 1, a.rule.quantum, level.share.next->at(0),
                      level.compacted.next->at(0));
    }
    slide_row<kWeighted, kPlanes, kKeep, kPatchWidth>(cells_left(patch, y), patch.soil, a.rule,
                                                      flux_x.at(0));
    if constexpr (kLoad)
        push_row(patch.load.push_x.row(y), level.share.here->at(-1), level.share.here->at(0),
                 a.rule.quantum, flux_x.at(0));
    const bool two_loops = !kLoad && has_below && a.rule.border == Border::NoFlux;
    if (!two_loops && has_below)
        faces_above<kWeighted, kPlanes, kKeep, kLoad>(a, level, y + 1, level.flux_z.next->at(0));
    else if (!has_below)
        level.flux_z.next->clear();
    hold_rim_columns(a, level.flux_z.here->at(0), level.flux_z.next->at(0), flux_x.at(0));
    if (two_loops)
        slide_level_row<kWeighted, kPlanes, kKeep>(a, level, y, flux_x);
    else
        update_level_row<kLoad>(a, level, y, flux_x);
    const int tile_row = y - kHalo;
    if constexpr (kLoad)
        if (patch.load.compaction.values && tile_row >= 0 && tile_row < kTileHeight)
            a.change.compacted += tile_sum(level.compacted.here->at(0));
    level.flux_z.advance();
}

/// Copy patch row y from the tiles, and ask for one to come.
[[gnu::always_inline]] inline void gather_row(const Patch& patch, int y) {
    const int tile_row = y - kHalo;
    const int band = tile_row < 0 ? 0 : (tile_row < kTileHeight ? 1 : 2);
    const std::ptrdiff_t at = (tile_row - (band - 1) * kTileHeight) * std::ptrdiff_t{kTileWidth};
    const auto& tiles = patch.source.tiles[band];
    float* u = patch.u + y * kPatchWidth;
    std::memcpy(u, tiles[0] + at + kTileWidth - kHalo, kHalo * sizeof(float));
    std::memcpy(u + kHalo, tiles[1] + at, kTileWidth * sizeof(float));
    std::memcpy(u + kHalo + kTileWidth, tiles[2] + at, kHalo * sizeof(float));
    if (band != 1 || tile_row + kRowsAhead >= kTileHeight)
        return;
    const std::ptrdiff_t ahead = at + kRowsAhead * kTileWidth;
    fetch_row(tiles[0] + ahead + kTileWidth - kHalo, 1);
    fetch_row(tiles[1] + ahead, kTileWidth);
    fetch_row(tiles[2] + ahead, 1);
}

template <bool kWeighted, bool kPlanes, bool kKeep, bool kLoad>
[[gnu::always_inline]] inline void step_rows(const Arguments& a) {
    std::array<LevelOf<kLoad>, kMostBlocked> levels;
    Row flux_x;
    const PatchSteps& steps = a.steps;
    int first = kPatchHeight;
    int end = 0;
    for (int i = 0; i < steps.iterations; ++i) {
        const int left = steps.iterations - 1 - i;
        LevelOf<kLoad>& level = levels[static_cast<std::size_t>(i)];
        level.begin = std::max(steps.first - left, steps.least_row);
        level.end = std::min(steps.end + left, steps.rows_bound);
        level.last = left == 0;
        first = std::min(first, level.begin + i);
        end = std::max(end, level.end + i);
    }
    gather_row(a.patch, levels.front().begin - 1);
    gather_row(a.patch, levels.front().begin);
    for (int front = first; front < end; ++front) {
        if (front < levels.front().end)
            gather_row(a.patch, front + 1);
        if (front + kRowsAhead < levels.front().end)
            fetch_row(a.patch.base.row(front + kRowsAhead), kPatchWidth);
        const int written = front - (steps.iterations - 1) - kHalo + kRowsAhead;
        if (written >= 0 && written < kTileHeight)
            fetch_row_to_write(a.out + written * kTileWidth, kTileWidth);
        for (int i = 0; i < steps.iterations; ++i) {
            LevelOf<kLoad>& level = levels[static_cast<std::size_t>(i)];
            const int y = front - i;
            if (y < level.begin || y >= level.end)
                continue;
            if (y == level.begin)
                begin_level<kWeighted, kPlanes, kKeep, kLoad>(a, level);
            step_level_row<kWeighted, kPlanes, kKeep, kLoad>(a, level, y, flux_x);
        }
    }
}

SCREE_MULTIVERSION void excess_uniform(const Arguments& a) {
    step_rows<false, false, true, false>(a);
}
SCREE_MULTIVERSION void excess_planes(const Arguments& a) {
    step_rows<false, true, true, false>(a);
}
SCREE_MULTIVERSION void excess_load(const Arguments& a) {
    step_rows<false, true, true, true>(a);
}
SCREE_MULTIVERSION void weighted_planes(const Arguments& a) {
    step_rows<true, true, true, false>(a);
}
SCREE_MULTIVERSION void weighted_load(const Arguments& a) {
    step_rows<true, true, true, true>(a);
}
SCREE_MULTIVERSION void loose_uniform(const Arguments& a) {
    step_rows<false, false, false, false>(a);
}
SCREE_MULTIVERSION void loose_planes(const Arguments& a) {
    step_rows<false, true, false, false>(a);
}
SCREE_MULTIVERSION void loose_load(const Arguments& a) {
    step_rows<false, true, false, true>(a);
}
SCREE_MULTIVERSION void loose_weighted_planes(const Arguments& a) {
    step_rows<true, true, false, false>(a);
}
SCREE_MULTIVERSION void loose_weighted_load(const Arguments& a) {
    step_rows<true, true, false, true>(a);
}
}  // namespace

void step_patch(const Patch& patch, const SoundRule& rule, const PatchSteps& steps, float* out,
                PatchChange& change) {
    const Arguments a{patch, rule, steps, out, change};
    const bool weighted = rule.slide != Slide::Excess;
    const bool keep = rule.keep_base;
    if (patch.load.underside.values && weighted)
        keep ? weighted_load(a) : loose_weighted_load(a);
    else if (patch.load.underside.values)
        keep ? excess_load(a) : loose_load(a);
    else if (weighted)
        keep ? weighted_planes(a) : loose_weighted_planes(a);
    else if (patch.soil.uniform)
        keep ? excess_uniform(a) : loose_uniform(a);
    else
        keep ? excess_planes(a) : loose_planes(a);
}

}  // namespace scree::terrain
