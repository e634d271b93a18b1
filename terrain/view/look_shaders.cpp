#include "terrain/view/look_shaders.h"

namespace scree::terrain {

std::string_view heights_glsl() {
    // Heights of the ground at a place in the world.
    return R"glsl(
layout(binding = 0) uniform sampler2D base_heights;
layout(binding = 1) uniform sampler2D moved_heights;
uniform vec2 ground_origin;   // corner of the window, metres
uniform vec2 per_ground_size; // 1 / its sides

vec2 ground_uv(vec2 at) { return (at - ground_origin) * per_ground_size; }
)glsl";
}

std::string_view looks_glsl() {
    // Where the blend of a place is looked up: moved by noise of half a cell, so that borders do
    // not show the cells.
    return R"glsl(
struct Look {
    vec4 colour;   // linear; w: roughness
    vec4 measure;  // 1 / size, height of the detail, its greatest slope, 1 where there is a picture
    vec4 kind;     // x: 1 for gravel that has rocks near the eye
};
layout(std430, binding = 0) readonly buffer Looks { Look looks[]; };

vec2 torn(vec2 at) {
    vec2 cell = at / SCREE_CELL - 0.5;
    vec2 moved = 0.8 * vec2(lattice_noise(cell * 0.7), lattice_noise(cell.yx * 0.7 + 31.0)) +
                 0.5 * vec2(lattice_noise(cell * 2.3), lattice_noise(cell.yx * 2.3 + 57.0)) - 0.65;
    return at + moved * SCREE_CELL;
}
)glsl";
}

}  // namespace scree::terrain
