#pragma once

#include "terrain/grid/soil_field.h"

#include <array>
#include <cstdint>
#include <vector>

// For .cpp files alone, not installed.
namespace scree::terrain {

using SoilRecord = std::array<float, 4>;  ///< Repose, diffusion, mobility, compaction.

/// Soils of every cell as places in a table of at most 256; `fits` is false where they are more.
struct SoilPalette {
    std::vector<SoilRecord> table;
    Raster<std::uint8_t> index;
    Raster<SoilRecord> cells;  ///< Where they do not fit.
    bool fits = true;
};

/// @param angles  The repose in radians instead of by its tangent.
SoilPalette soil_palette(const SoilField& soil, int width, int height, bool angles);

}  // namespace scree::terrain
