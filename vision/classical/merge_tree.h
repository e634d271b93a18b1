#pragma once

#include "vision/classical/basins.h"
#include "vision/edge_field.h"

#include <cstdint>
#include <vector>

namespace scree::vision {

/// What is known of a stretch of border, a pixel side at a time; stretches add up.
struct BorderStats {
    float length = 0;    ///< Pixel sides.
    float sum = 0;       ///< Of the boundary channel, the stronger of the two pixels of a side.
    float weak = 0;      ///< Sides below 0.25.
    float middling = 0;  ///< Sides below 0.5.
    float depth = 0;     ///< Of the distance channel, the lesser of the two pixels of a side.

    BorderStats& operator+=(const BorderStats& o);
    float mean() const { return length > 0 ? sum / length : 0.0F; }
};

/// What is known of a set of pixels; disjoint sets add up.
struct AreaStats {
    double area = 0;
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;    ///< Sums of positions and their products.
    double inside = 0, boundary = 0, distance = 0;  ///< Sums of the channels.
    double luma = 0, luma2 = 0;                     ///< Sums of the brightness and its square.
    float deepest = 0;                              ///< Greatest value of the distance channel.

    AreaStats& operator+=(const AreaStats& o);
};

/// One region of the hierarchy: a basin or the union of two regions.
struct RegionNode {
    int left = -1;  ///< -1 at a basin.
    int right = -1;
    int parent = -1;   ///< -1 at a root.
    float height = 0;  ///< Mean boundary along the border that the union removed.
    float pass = 0;    ///< Greatest depth of a side of that border: 0 if it is a true one.
    AreaStats pixels;
    BorderStats outer;    ///< Whole border.
    BorderStats open;     ///< Part of it against pixels that belong to no basin.
    BorderStats removed;  ///< All borders removed so far within.
    float frame = 0;      ///< Sides on the picture's edge.
    float strongest = 0;  ///< Highest union within.
    float split = 0;      ///< Of the unions within, the most that the lesser peak of the distance
                          ///< channel stood above the pass: high if these are two rocks.
    int peaks = 1;        ///< Peaks of the distance channel that stand out above their passes.
};

/// Hierarchy of regions: basins first, then unions in the order they were made.
struct MergeTree {
    std::vector<RegionNode> nodes;
    int n_basins = 0;
};

/// Unite neighbouring basins, the pair with the weakest common border first.
///
/// @pre   Boundary, inside and distance are filled and of the basins' size.
/// @param highest  Pairs whose common border is stronger than this stay apart.
MergeTree build_merge_tree(const BasinMap& basins, const EdgeField& field, const FloatRaster& luma,
                           float highest);

}  // namespace scree::vision
