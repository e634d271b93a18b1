#pragma once

#include <string_view>

namespace scree::terrain {

/// Sun, sky, the objects' shadow and the curve from light to picture, shared by all that is drawn:
/// `vec3 lit_colour(albedo, normal, open, sun, roughness, world)`, `float object_shadow(world)`,
/// `vec3 shown(colour)`, `float patches(at)`.
/// Needs noise_glsl() before it.
std::string_view light_glsl();

/// `float lattice_noise(vec2 at)`: smooth noise over the unit lattice, 0 to 1, the same everywhere.
std::string_view noise_glsl();

}  // namespace scree::terrain
