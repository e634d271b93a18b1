#pragma once

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

/// Ask for the lines of memory of a row; `kWrite` 1 if they will be written, `kLocality` as the
/// compiler's intrinsic takes it.
template <int kWrite, int kLocality>
[[gnu::always_inline]] inline void prefetch_row([[maybe_unused]] const float* row,
                                                [[maybe_unused]] int n) {
#if defined(__GNUC__)
    constexpr int kLine = 16;  // floats
    for (int x = 0; x < n; x += kLine)
        __builtin_prefetch(row + x, kWrite, kLocality);
#endif
}

/// Ask for the heights of a row to come: rows of the base are far apart in memory, where no machine
/// looks ahead by itself.
[[gnu::always_inline]] inline void fetch_row(const float* row, int n) {
    prefetch_row<0, 2>(row, n);
}

/// The same of a row to be written: it is read before a part of it can change.
[[gnu::always_inline]] inline void fetch_row_to_write(float* row, int n) {
    prefetch_row<1, 3>(row, n);
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

inline void note_row(PatchChange& change, int row, std::uint32_t changed) {
    if (changed == 0)
        return;
    change.first_row = std::min(change.first_row, row);
    change.last_row = row;
}

}  // namespace scree::terrain
