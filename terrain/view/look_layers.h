#pragma once

#include "terrain/view/material_look.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::terrain {

/// What a shader knows of a look, laid out as its buffer has it.
struct LookRecord {
    glm::vec4 colour{0.0F};   ///< Linear light; w: roughness.
    glm::vec4 measure{0.0F};  ///< 1 / size, height of the detail's full range, its greatest slope,
                              ///< 1 where there is a colour picture.
    glm::vec4 kind{0.0F};     ///< x: 1 for gravel that has rocks near the eye.
};

/// Looks as layers of equal size, for texture arrays, one layer after the other; RGBA8 but for the
/// relief.
struct LookLayers {
    int side = 1;  ///< Of a layer, texels; a power of two.
    std::vector<LookRecord> records;
    std::vector<std::uint8_t> albedo;  ///< sRGB, alpha 255, of the looks that have a picture.
    std::vector<std::uint8_t> detail;  ///< Slopes along x and z, height about its mean, open sky.
    std::vector<float> relief;  ///< Heights about their mean, metres, of the looks that have any.
};

/// Resample looks to the largest side that any of them has, at most 1024, and less where the
/// layers would take more than `max_bytes`.
/// @throw InvalidInput  a look's size or displacement is no number; names the look.
LookLayers make_look_layers(std::span<const MaterialLook> looks,
                            std::size_t max_bytes = std::size_t{512} << 20U);

/// Linear light of an sRGB value, both 0 to 1.
float linear_of_srgb(float value);

}  // namespace scree::terrain
