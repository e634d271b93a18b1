#pragma once

#include "terrain/material/description_map.h"

#include <vector>

namespace scree::terrain {

/// A map as a picture to look at: materials in their colours, edges between them darker, and
/// brighter where a cell's own angle of repose is above its material's. Small maps are enlarged,
/// each cell to the same square, until the longer side has at least `least_size` pixels.
/// @throw InvalidInput  the map breaks check_map().
Photo description_picture(const DescriptionMap& map, int least_size = 512);

/// Share of the cells that every material has, in the table's order.
std::vector<double> material_shares(const DescriptionMap& map);

}  // namespace scree::terrain
