#pragma once

#include "terrain/material/description_map.h"

#include <vector>

namespace scree::terrain {

/// Colours that tell the materials apart, in the table's order: their own, or another where that is
/// too near to an earlier one's.
std::vector<glm::u8vec3> legend_colours(const std::vector<Material>& materials);

/// A map as a picture to look at: materials in their legend's colours, edges between them darker,
/// and brighter where a cell's own angle of repose is above its material's. Small maps are
/// enlarged, each cell to the same square, until the longer side has at least `least_size` pixels.
/// @throw InvalidInput  the map breaks check_map().
Photo description_picture(const DescriptionMap& map, int least_size = 512);

enum class MapChannel { Repose, Mobility, Diffusion };

/// One parameter of every cell in grey, a pixel a cell: black is 0, white 90 degrees or the
/// greatest value of the map. @throw InvalidInput  the map breaks check_map().
Raster<std::uint8_t> channel_picture(const DescriptionMap& map, MapChannel channel);

/// Share of the cells that every material has, in the table's order.
std::vector<double> material_shares(const DescriptionMap& map);

}  // namespace scree::terrain
