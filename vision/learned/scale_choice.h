#pragma once

#include "vision/learned/level_fusion.h"
#include "vision/learned/tile_plan.h"

#include <array>
#include <span>
#include <vector>

namespace scree::vision {

/// How much of a finer scale's logits come from that scale itself, by place, 0 to 1; the rest is
/// taken over from the next coarser one.
struct FineShare {
    FloatRaster by_place;  ///< Empty: 1 everywhere.

    /// Whether it is 0 in the whole tile, so that the scale need not be computed there.
    bool nothing_in(const Span& columns, const Span& rows) const;
};

/// Which sizes of rocks a scale is needed for, in diameters at that scale, px.
struct ScaleChoice {
    double full = 96;   ///< Up to this size it is taken whole.
    double none = 160;  ///< From this size on the coarser one stands in for it.
};

/// Choose where the next finer scale is needed, by the size of the rocks that the coarser one
/// shows: on a rock the relative distance to the border climbs from 0 to 1 over its least half
/// width, so the inverse of the mean slope is that half width.
///
/// @param coarse         Logits of the coarser scale.
/// @param width, height  Of the finer one: at most twice the coarser one's, or the same, where the
///                       finer one was brought to the size of the coarser.
/// Where the coarser one shows little rock, the finer one is taken whole.
FineShare choose_share(const LogitPlanes& coarse, int width, int height, const ScaleChoice& choice);

/// Choose where a closer look is worth its price: where the field leaves open what is rock and what
/// is ground, as between the pebbles of a conglomerate and its matrix.
///
/// With i the inside value, 4 i (1 - i) is 0 where it is sure and 1 where it is not. The share
/// climbs from 0, where the mean of that over some 100 px is `doubt`, to 1 at `doubt` + 0.1.
FineShare choose_doubtful(const FloatRaster& inside_logits, double doubt);

/// Twice the size, linearly, cut to `width` x `height`.
FloatRaster enlarged(const FloatRaster& coarse, int width, int height);

/// Keep of the coarser scale what it stands in for: multiply by 1 - share.
void make_room(LogitPlanes& planes, const FineShare& share);

/// A tile's place and its weights against the tiles that overlap it.
struct FineTile {
    Span columns, rows;
    std::vector<float> column_weights, row_weights;
};

/// The same at half the size.
/// @pre  Begin and size are even.
FineTile halved(const FineTile& tile);

/// Means of 2 x 2 values of kFieldChannels planes of width x height, in place of them.
void halve_planes(std::vector<float>& planes, int width, int height);

/// Add a tile of the finer scale by its share and its weights.
/// @param logits  kFieldChannels planes of the tile; what lies beyond the picture is left out.
void add_tile(const FineTile& tile, std::span<const float> logits, const FineShare& share,
              LogitPlanes& planes);

}  // namespace scree::vision
