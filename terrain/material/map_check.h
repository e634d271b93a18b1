#pragma once

#include "terrain/material/description_map.h"

#include <array>
#include <string_view>

namespace scree::terrain {

inline constexpr double kMaxMapCells = 200e6;      ///< Cells of a map.
inline constexpr std::size_t kMaxMaterials = 256;  ///< As many as an 8-bit id tells apart.

/// Throw InvalidInput unless a map of this size may be made; call it before memory is taken.
void check_map_size(double width, double height, std::string_view source);

/// Check a table of materials: ids from 0 to 255 in order and unique, names that are given, unique
/// and without control characters, soils in the ranges of describe(), textures of positive size,
/// hats that are all -1 or 0 <= start <= peak <= end <= 1, an albedo texture for gravel.
/// @throw InvalidInput  names `source`, the id and the value.
void check_materials(const std::vector<Material>& materials, std::string_view source);

/// Check a whole map: its table, its size and cell size, a material for every id, planes as large
/// as the ids, every parameter a number, not negative, repose below 90 degrees, the others at most
/// what a soil may have.
/// @throw InvalidInput  names `source`, the cell, the id and the value.
void check_map(const DescriptionMap& map, std::string_view source);

/// Place of every id in the table; -1 where there is no such material.
std::array<int, 256> slots_of_ids(const std::vector<Material>& materials);

/// The material's colour, or one by its id that differs from its neighbours'; sRGB.
glm::u8vec3 material_colour(const Material& material);

}  // namespace scree::terrain
