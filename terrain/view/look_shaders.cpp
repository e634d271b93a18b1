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
    // The looks that meet at a place: the four nearest cells of the map, weighted bilinearly; equal
    // ones are looked up once (corner blend, rocks-and-deformer.md D.4). The place is moved by
    // noise of half a cell, so that borders do not show the cells.
    return R"glsl(
struct Look {
    vec4 colour;   // linear; w: roughness
    vec4 measure;  // 1 / size, height of the detail, its greatest slope, 1 where there is a picture
};
layout(std430, binding = 0) readonly buffer Looks { Look looks[]; };
layout(binding = 4) uniform usampler2D layers;
layout(binding = 5) uniform sampler2DArray albedo;
layout(binding = 6) uniform sampler2DArray detail;
uniform float map_cells_per_m;
uniform ivec2 map_size;

struct Blend {
    uvec4 layer;
    vec4 weight;
};

Blend corner_blend(vec2 at) {
    vec2 cell = at * map_cells_per_m - 0.5;
    cell += 0.8 * vec2(lattice_noise(cell * 0.7), lattice_noise(cell.yx * 0.7 + 31.0)) +
            0.5 * vec2(lattice_noise(cell * 2.3), lattice_noise(cell.yx * 2.3 + 57.0)) - 0.65;
    vec2 low = floor(cell);
    vec2 f = cell - low;
    f = f * f * (3.0 - 2.0 * f);
    ivec2 a = clamp(ivec2(low), ivec2(0), map_size - 1);
    ivec2 b = clamp(ivec2(low) + 1, ivec2(0), map_size - 1);
    Blend blend;
    blend.layer = uvec4(texelFetch(layers, a, 0).r, texelFetch(layers, ivec2(b.x, a.y), 0).r,
                        texelFetch(layers, ivec2(a.x, b.y), 0).r, texelFetch(layers, b, 0).r);
    blend.weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    for (int i = 1; i < 4; ++i)
        for (int k = 0; k < i; ++k)
            if (blend.layer[i] == blend.layer[k] && blend.weight[k] > 0.0) {
                blend.weight[k] += blend.weight[i];
                blend.weight[i] = 0.0;
            }
    return blend;
}
)glsl";
}

}  // namespace scree::terrain
