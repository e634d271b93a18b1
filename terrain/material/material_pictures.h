#pragma once

#include "base/raster.h"
#include "terrain/material/description_map.h"
#include "vision/image_io.h"

namespace scree::terrain {

/// The textures of a material in memory; empty where it has none.
struct MaterialPictures {
    Photo albedo;              ///< sRGB.
    FloatRaster displacement;  ///< Metres.
    Photo normal;              ///< Tangent space.
};

/// Displacement of a material's texture, metres; empty if it has none. Pictures that carry no scale
/// of their own are shares of `displacement_m`.
/// @throw IoError, InvalidInput
FloatRaster read_displacement(const MaterialTextures& textures,
                              const vision::ReadLimits& limits = {});

/// All of a material's textures. @throw IoError, InvalidInput
MaterialPictures read_material_pictures(const MaterialTextures& textures,
                                        const vision::ReadLimits& limits = {});

}  // namespace scree::terrain
