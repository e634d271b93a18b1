// One iteration on a tile where it lies: with a single iteration there is nothing to gain from
// gathering the tile and its halo first.
#include "base/simd.h"
#include "terrain/grid/tile_slide.h"

namespace scree::terrain {
namespace {

constexpr int kRowsAhead = 2;

struct DirectArguments {
    const DirectTile& tile;
    const SoundRule& rule;
    int begin, end;
    float* out;
    PatchChange& change;
};

/// Displacements of a row of a tile, or of the last or first row of the tiles above and below.
[[gnu::always_inline]] inline const float* direct_row(const DirectTile& tile, int y) {
    if (y < 0)
        return tile.above + (kTileHeight - 1) * kTileWidth;
    return y < kTileHeight ? tile.here + y * kTileWidth : tile.below;
}

/// Tile row y and the one above it.
[[gnu::always_inline]] inline Between direct_rows_above(const DirectTile& tile, int y) {
    const PatchPlane& threshold = tile.soil.threshold_plane;
    const int soil_row = y + kHalo;
    return {direct_row(tile, y - 1),
            direct_row(tile, y),
            tile.base.row(y - 1),
            tile.base.row(y),
            threshold.row(soil_row - 1) + kHalo,
            threshold.row(soil_row) + kHalo,
            tile.soil.diffusion_z.row(soil_row) + kHalo};
}

template <bool kWeighted, bool kPlanes, bool kKeep>
[[gnu::always_inline]] inline void direct_faces_left(const DirectArguments& a, int y, float* flux) {
    const DirectTile& tile = a.tile;
    const float* u = direct_row(tile, y);
    const float* base = tile.base.row(y);
    const float* threshold = tile.soil.threshold_plane.row(y + kHalo) + kHalo;
    const float* diffusion = tile.soil.diffusion_x.row(y + kHalo) + kHalo;
    slide_row<kWeighted, kPlanes, kKeep, kTileWidth>(
        {u - 1, u, base - 1, base, threshold - 1, threshold, diffusion}, tile.soil, a.rule, flux);
    // The first face and the one after the last lie between this tile and its neighbours.
    constexpr int n = kTileWidth;
    flux[0] = tile.left
                  ? slide_flux<kWeighted, kKeep>(tile.left[y * n + n - 1], u[0], base[-1], base[0],
                                                 threshold[-1], threshold[0], diffusion[0], a.rule)
                  : 0.0F;
    flux[n] = tile.right ? slide_flux<kWeighted, kKeep>(u[n - 1], tile.right[y * n], base[n - 1],
                                                        base[n], threshold[n - 1], threshold[n],
                                                        diffusion[n], a.rule)
                         : 0.0F;
}

template <bool kWeighted, bool kPlanes, bool kKeep>
[[gnu::always_inline]] inline void step_direct_rows(const DirectArguments& a) {
    Row flux_x;
    RowPair flux_z;  // above and below the row
    if (a.begin > 0 || a.tile.above)
        slide_row<kWeighted, kPlanes, kKeep, kTileWidth>(direct_rows_above(a.tile, a.begin),
                                                         a.tile.soil, a.rule, flux_z.here->at(0));
    else
        flux_z.here->clear();
    for (int y = a.begin; y < a.end; ++y) {
        if (y + kRowsAhead < kTileHeight)
            fetch_row(a.tile.base.row(y + kRowsAhead), kTileWidth);
        direct_faces_left<kWeighted, kPlanes, kKeep>(a, y, flux_x.at(0));
        const RowFlux fluxes{flux_x.at(0), flux_z.here->at(0), flux_z.next->at(0), nullptr};
        float* out = a.out + y * kTileWidth;
        std::uint32_t changed = 0;
        if (y + 1 < kTileHeight || a.tile.below) {
            changed = slide_and_update<kWeighted, kPlanes, kKeep, kTileWidth, true>(
                direct_rows_above(a.tile, y + 1), a.tile.soil, a.rule, fluxes, flux_z.next->at(0),
                out, a.change.columns);
        } else {
            flux_z.next->clear();
            changed = update_row<kTileWidth, false, true>(fluxes, direct_row(a.tile, y), out,
                                                          a.change.columns);
        }
        note_row(a.change, y, changed);
        flux_z.advance();
    }
}

SCREE_MULTIVERSION void direct_excess_uniform(const DirectArguments& a) {
    step_direct_rows<false, false, true>(a);
}
SCREE_MULTIVERSION void direct_excess_planes(const DirectArguments& a) {
    step_direct_rows<false, true, true>(a);
}
SCREE_MULTIVERSION void direct_weighted(const DirectArguments& a) {
    step_direct_rows<true, true, true>(a);
}
SCREE_MULTIVERSION void direct_loose_uniform(const DirectArguments& a) {
    step_direct_rows<false, false, false>(a);
}
SCREE_MULTIVERSION void direct_loose_planes(const DirectArguments& a) {
    step_direct_rows<false, true, false>(a);
}
SCREE_MULTIVERSION void direct_loose_weighted(const DirectArguments& a) {
    step_direct_rows<true, true, false>(a);
}

}  // namespace

void step_tile(const DirectTile& tile, const SoundRule& rule, int begin, int end, float* out,
               PatchChange& change) {
    const DirectArguments arguments{tile, rule, begin, end, out, change};
    if (rule.slide != Slide::Excess)
        rule.keep_base ? direct_weighted(arguments) : direct_loose_weighted(arguments);
    else if (rule.keep_base)
        tile.soil.uniform ? direct_excess_uniform(arguments) : direct_excess_planes(arguments);
    else
        tile.soil.uniform ? direct_loose_uniform(arguments) : direct_loose_planes(arguments);
}

}  // namespace scree::terrain
