#pragma once

#include <string_view>

namespace scree::terrain {

/// Textures of the ground's heights and `vec2 ground_uv(vec2 at)`, a place in them.
std::string_view heights_glsl();

/// The looks' buffer and pictures, and `Blend corner_blend(vec2 at)`: which of them meet at a place
/// and with what weights. Needs noise_glsl() before it.
std::string_view looks_glsl();

}  // namespace scree::terrain
