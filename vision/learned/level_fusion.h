#pragma once

#include "base/raster.h"
#include "vision/learned/outline_network.h"
#include "vision/learned/tile_plan.h"

#include <array>
#include <span>
#include <vector>

namespace scree::vision {

/// Logits of boundary, inside and distance at one level.
using LogitPlanes = std::array<FloatRaster, kFieldChannels>;

/// Share that the next finer level has in the fused field, by place; the coarser ones together
/// have the rest.
struct FineShare {
    float most = 1.0F;  ///< Where `by_place` is empty.
    FloatRaster by_place;

    /// Whether it is 0 in the whole tile, so that the level need not be computed there.
    bool nothing_in(const Span& columns, const Span& rows) const;
};

/// Which sizes of rocks a level is needed for, in diameters at that level, px.
struct ScaleChoice {
    double full = 96;   ///< Up to this size the level has its whole share.
    double none = 160;  ///< From this size on it has none: the coarser ones see the rock as well.
};

/// Choose how much the next finer level counts, by the size of the rocks that the field of the
/// coarser ones shows: on a rock the relative distance to the border climbs from 0 to 1 over its
/// least half width, so the inverse of the mean slope is that half width. Where little rock was
/// seen, the finer level has its whole share.
///
/// @param coarse  Fused logits of the coarser levels, at the size of the last of them.
/// @param width, height  Of the finer level, at most twice the coarser one's.
/// @param most    The whole share, 0 to 1.
FineShare choose_share(const LogitPlanes& coarse, int width, int height, float most,
                       const ScaleChoice& choice);

/// Twice the size, linearly, cut to `width` x `height`.
FloatRaster doubled(const FloatRaster& coarse, int width, int height);

/// Leave the coarser levels their part of what will be the mean: multiply by 1 - share.
void make_room(LogitPlanes& fused, const FineShare& share);

/// Add a tile of the finer level, weighed by its share and by the weights that tiles have of one
/// another's overlap.
/// @param logits  kFieldChannels planes of the tile; what lies beyond the level's size is left out.
struct FineTile {
    Span columns, rows;
    std::vector<float> column_weights, row_weights;
};
void add_tile(const FineTile& tile, std::span<const float> logits, const FineShare& share,
              LogitPlanes& fused);

/// 1 / (1 + e^-x) of every value, in place.
void squash(FloatRaster& plane);

}  // namespace scree::vision
