#pragma once

#include "terrain/material/description_map.h"
#include "terrain/material/material_pictures.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// How the shaders are given the materials' textures.
enum class TextureBinding {
    Separate,  ///< `sampler2D NAME[N]`: any sizes; at most as many as the card has units.
    Layers,    ///< `sampler2DArray NAME`: one unit, N layers, all resampled to one size.
};
inline constexpr std::string_view kTextureBindingNames[] = {"separate", "layers"};
constexpr std::span<const std::string_view> names_of(TextureBinding) {
    return kTextureBindingNames;
}

struct ShaderOptions {
    TextureBinding binding = TextureBinding::Separate;
    bool literal_hat = false;  ///< Blend by the filtered id (4.15) instead of by corners.
    int max_textures = 32;     ///< Of one kind; more need Layers.
};

template <class Visitor>
void describe(ShaderOptions& o, Visitor&& field) {
    field("binding", o.binding, {.help = "how the shaders are given textures"});
    field("literal-hat", o.literal_hat, {.help = "blend by the filtered id, as published"});
    field("max-textures", o.max_textures,
          {.min = 1, .max = 256, .help = "most separate textures of one kind"});
}

/// GLSL 4.50 made for a map (`rocks-and-deformer.md` D.3).
///
/// The functions take a place on the ground in metres (world x and z) and read
///   uniform usampler2D scree_ids;             the ids, GL_R8UI, never filtered
///   uniform sampler2D  scree_albedo[A];       GL_SRGB8, repeating, trilinear
///   uniform sampler2D  scree_normal[N];       linear colours, repeating, trilinear
///   uniform sampler2D  scree_displacement[D]; GL_R32F, metres, repeating: read_displacement()
/// (`sampler2DArray` without the brackets for Layers). A sampler whose list below is empty is not
/// declared. Entry i of a list is the place in the map's table of the material that texture i
/// belongs to. A material without a texture has its plain colour, a flat normal or no displacement.
struct GroundShaders {
    /// `vec3 scree_ground_colour(vec2)`, linear light, and `vec3 scree_ground_normal(vec2)`, in
    /// tangent space (x along +X, y along -Z, z up); without main() and #version.
    std::string fragment_functions;
    /// `float scree_ground_displacement(vec2 ground, float lod)`, metres; likewise.
    std::string evaluation_functions;
    std::string fragment;    ///< A whole fragment shader around the functions.
    std::string evaluation;  ///< A whole tessellation-evaluation shader around them.

    std::vector<int> albedo;        ///< Materials of scree_albedo, A of them.
    std::vector<int> normal;        ///< Materials of scree_normal.
    std::vector<int> displacement;  ///< Materials of scree_displacement.
};

/// @throw InvalidInput   the materials break check_materials(), the cell size is not positive, or
///                       they have more textures of one kind than may be bound apart.
/// @throw InvalidOption  a value is out of its range.
GroundShaders ground_shaders(const std::vector<Material>& materials, double cell_size,
                             const ShaderOptions& options = {});

}  // namespace scree::terrain
