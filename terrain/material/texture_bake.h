#pragma once

#include "base/options.h"
#include "base/progress.h"
#include "terrain/material/description_map.h"
#include "terrain/material/material_pictures.h"
#include "vision/image_io.h"

#include <vector>

namespace scree::terrain {

/// How the blend of a map's textures is baked.
struct BakeOptions {
    int size = 1024;             ///< Pixels along the longer side.
    bool literal_hat = false;    ///< Blend by the filtered id (4.15) instead of by corners.
    bool derive_normals = true;  ///< Without a normal texture take the displacement's slopes.
};

template <class Visitor>
void describe(BakeOptions& o, Visitor&& field) {
    field("size", o.size,
          {.min = 1, .max = 16384, .unit = "px", .help = "pixels along the longer side"});
    field("literal-hat", o.literal_hat, {.help = "blend by the filtered id, as published"});
    field("derive-normals", o.derive_normals,
          {.help = "without a normal texture take the displacement's slopes"});
}

/// What the generated shaders show, as pictures for engines that take no shaders.
struct BakedGround {
    Photo albedo;                      ///< sRGB.
    Photo normal;                      ///< Tangent space, as glTF has it; flat is 128, 128, 255.
    vision::HeightImage displacement;  ///< Metres.
};

/// Blend the materials' textures over the whole map. Textures repeat from the corner of cell (0,
/// 0), are first averaged to the pixels' size where they are finer, and then interpolated; colours
/// are mixed in linear light. A material without a texture has its plain colour, a flat normal or
/// no displacement. The same bytes for any number of threads.
/// @param pictures  Of every material of the table, in its order.
/// @throw InvalidInput   the map breaks check_map() or there are not as many pictures as materials.
/// @throw InvalidOption  a value is out of its range.
/// @throw Cancelled
BakedGround bake_textures(const DescriptionMap& map, const std::vector<MaterialPictures>& pictures,
                          const BakeOptions& options = {}, Progress* progress = nullptr);

/// Read the textures of all materials and bake. @throw IoError, InvalidInput
BakedGround bake_texture_files(const DescriptionMap& map, const BakeOptions& options = {});

}  // namespace scree::terrain
