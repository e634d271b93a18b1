#pragma once

#include "base/options.h"
#include "base/raster.h"
#include "meshing/gltf/gltf_scene.h"

#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::meshing {

/// A box of texture coordinates of a picture.
struct TextureBox {
    glm::vec2 low{0.0F};
    glm::vec2 high{0.0F};
};

/// Where a box went: coordinates in the atlas are scale * old + offset, held inside `tile`.
struct TextureMove {
    glm::vec2 scale{1.0F};
    glm::vec2 offset{0.0F};
    TextureBox tile;
};

/// Parts of a picture packed into a smaller one.
struct TextureAtlas {
    Photo picture;
    std::vector<TextureMove> moves;  ///< One a box, in their order.
    int reduction = 1;               ///< The parts are that many times smaller than they were.
};

struct AtlasOptions {
    int max_side = 1024;  ///< Neither side of the atlas is larger, px.
    int margin = 2;       ///< Pixels of the surroundings kept about every box.
    int quality = 85;     ///< Of the JPEG.
};

template <class Visitor>
void describe(AtlasOptions& o, Visitor&& field) {
    field("max-side", o.max_side,
          {.min = 64, .max = 16384, .unit = "px", .help = "largest side of the atlas"});
    field("margin", o.margin,
          {.min = 0, .max = 16, .unit = "px", .help = "surroundings kept about every part"});
    field("quality", o.quality, {.min = 1, .max = 100, .help = "of the JPEG"});
}

/// Pack boxes of a picture, reduced by a whole factor, the least (to an eighth) that
/// lets them fit.
/// @throw InvalidInput  the picture is empty, a box is no box, or more boxes than fit at a pixel
///        each.
TextureAtlas pack_textures(const Photo& photo, std::span<const TextureBox> boxes,
                           const AtlasOptions& options = {});

/// Every `factor` x `factor` pixels become one, their mean.
/// @throw InvalidInput  the factor is under 1 or the picture is empty.
Photo reduced_photo(const Photo& photo, int factor);

/// Give the scene a texture that holds only what its meshes show of the photograph, and move their
/// texture coordinates there. A patch of a few rocks then carries a few hundred kilobytes of
/// picture instead of the whole photograph.
/// @pre Texture coordinates point into the photograph.
void use_texture_atlas(GltfScene& scene, const Photo& photo, const AtlasOptions& options = {});

}  // namespace scree::meshing
