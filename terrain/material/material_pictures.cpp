#include "terrain/material/material_pictures.h"

namespace scree::terrain {

FloatRaster read_displacement(const MaterialTextures& textures, const vision::ReadLimits& limits) {
    if (textures.displacement.empty())
        return {};
    vision::HeightImage heights = vision::read_heights(textures.displacement, limits);
    if (!heights.in_metres)
        for (float& value : heights.metres)
            value *= static_cast<float>(textures.displacement_m);
    return std::move(heights.metres);
}

MaterialPictures read_material_pictures(const MaterialTextures& textures,
                                        const vision::ReadLimits& limits) {
    MaterialPictures pictures;
    if (!textures.albedo.empty())
        pictures.albedo = vision::read_photo(textures.albedo, limits).pixels;
    pictures.displacement = read_displacement(textures, limits);
    if (!textures.normal.empty())
        pictures.normal = vision::read_photo(textures.normal, limits).pixels;
    return pictures;
}

}  // namespace scree::terrain
