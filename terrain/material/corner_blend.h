#pragma once

#include "terrain/material/description_map.h"

#include <array>
#include <vector>

namespace scree::terrain {

/// How quickly each material of a table fades where it meets others, in shares of the way to the
/// neighbouring cell: 1 all the way, 0 at once. From the asymmetry of its hat: how far it reaches
/// down or up over the distance to the neighbour in the table, at most 1.
struct FadeTable {
    std::array<int, 256> slots;  ///< Place of every id in the table, -1 for none.
    std::vector<float> low;      ///< Towards materials of lower id.
    std::vector<float> high;     ///< Towards materials of higher id.
};

FadeTable fade_table(const std::vector<Material>& materials);

/// Shares of the at most four materials around a place.
struct CornerWeights {
    int count = 0;
    std::array<int, 4> slots{};      ///< Places in the table of materials.
    std::array<float, 4> weights{};  ///< They add up to one.
};

/// Blend the materials of the four nearest cells by their bilinear weights, so that no third
/// material appears between ids 0 and 2 (`rocks-and-deformer.md` D.4). A material of weight w fades
/// by the falling side of (4.15): 1 - (1 - w) / fade, where `fade` is the mean of its fades towards
/// what it meets. Where nothing is left, the greatest weight has it all.
///
/// In float and in the order of the generated shaders, which give the same to rounding.
/// @param x, y  In cells; cell (0, 0) has its centre at (0.5, 0.5). The rim is carried outwards.
/// @pre   Every id has a slot.
CornerWeights corner_weights(const Raster<std::uint8_t>& ids, const FadeTable& fades, float x,
                             float y);

}  // namespace scree::terrain
