#pragma once

#include "base/raster.h"
#include "terrain/material/description_map.h"

#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// How a material looks: pictures that repeat every `size_m` metres, each of any size.
struct MaterialLook {
    Photo albedo{};                         ///< sRGB; empty: `colour` alone.
    FloatRaster displacement{};             ///< Metres over the ground; empty: none.
    Photo normal{};                         ///< As glTF has it; empty: made from the displacement.
    double size_m = 1.0;                    ///< Edge of ground that one repetition covers, metres.
    glm::vec3 colour{0.52F, 0.47F, 0.41F};  ///< sRGB, 0 to 1, where there is no albedo.
    float roughness = 0.9F;                 ///< 0 is a mirror, 1 is chalk.
};

/// The looks of a map's materials, read from their files; materials without files get plain
/// colours that tell them apart.
///
/// A displacement file that says its scale is taken as it is; of another, white stands for the
/// material's `displacement_m`.
/// @throw IoError, InvalidInput  a file cannot be read; names it and the material.
std::vector<MaterialLook> load_looks(const DescriptionMap& map);

/// Looks without pictures, one for each material, in colours that tell them apart.
std::vector<MaterialLook> plain_looks(const DescriptionMap& map);

}  // namespace scree::terrain
