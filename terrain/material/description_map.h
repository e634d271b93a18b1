#pragma once

#include "base/raster.h"
#include "terrain/material/soil.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::terrain {

/// Pictures of a material that repeat over the ground. Empty paths: none.
struct MaterialTextures {
    std::filesystem::path albedo;        ///< sRGB colour.
    std::filesystem::path displacement;  ///< Heights; metres where the file says so.
    std::filesystem::path normal;        ///< Tangent space, as glTF has it.
    double size_m = 1.0;                 ///< Edge of ground that one repetition covers, metres.
    double displacement_m = 0.01;        ///< Height of white where the file carries no scale.

    bool operator==(const MaterialTextures&) const = default;
};

/// Where the hat function of a material starts, peaks and ends over the normalised id
/// (`rocks-and-deformer.md` eq. 4.15); all three -1: from its neighbours in the table.
struct HatShape {
    double start = -1.0;
    double peak = -1.0;
    double end = -1.0;

    bool operator==(const HatShape&) const = default;
};

/// One entry of the table that ids point into.
struct Material {
    int id = 0;  ///< 0 to 255.
    std::string name;
    Soil soil;
    MaterialTextures textures;
    bool gravel = false;  ///< Loose rocks: near the viewer their meshes are shown.
    HatShape hat;
    /// sRGB, in painted pictures and in views; none: material_colour() takes one by the id.
    std::optional<glm::u8vec3> colour;

    bool operator==(const Material&) const = default;
};

/// What the ground is made of, place by place: the sound form of the description map
/// (`rocks-and-deformer.md` D.1). Ids are whole numbers and never filtered.
///
/// The three planes hold parameters cell by cell where they differ from the materials' own; each
/// is empty (every cell takes its material's value) or as large as `ids`.
struct DescriptionMap {
    Raster<std::uint8_t> ids;
    FloatRaster repose;               ///< Radians.
    FloatRaster mobility;             ///< As Soil::mobility.
    FloatRaster diffusion;            ///< As Soil::diffusion.
    double cell_size = 1.0;           ///< Edge of a map cell, metres.
    std::vector<Material> materials;  ///< In order of id, ids unique.
};

}  // namespace scree::terrain
