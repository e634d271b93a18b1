#include "terrain/view/light_shaders.h"

namespace scree::terrain {

std::string_view light_glsl() {
    return R"glsl(
layout(binding = 7) uniform sampler2DShadow object_depth;
uniform mat4 shadow_from_world;
uniform vec3 sun_direction;   // unit, towards the sun
uniform vec2 light_strength;  // of the sun and of the sky
uniform vec3 eye;

// Nine taps of the objects' depth from the sun, each filtered over four texels.
float object_shadow(vec3 at) {
    vec3 place = (shadow_from_world * vec4(at, 1.0)).xyz;
    if (any(lessThan(place, vec3(0.0))) || any(greaterThan(place, vec3(1.0))))
        return 1.0;
    vec2 texel = 1.5 / vec2(textureSize(object_depth, 0));
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += texture(object_depth, vec3(place.xy + vec2(x, y) * texel, place.z - 0.0008));
    return sum / 9.0;
}

// Light that a surface sends to the eye: Lambert under sun and sky, and the sun's and the sky's
// gloss by the GGX distribution with Schlick's reflectance.
vec3 lit_colour(vec3 albedo, vec3 n, float open, float sun, float roughness, vec3 at) {
    vec3 to_eye = normalize(eye - at);
    float n_l = max(dot(n, sun_direction), 0.0);
    vec3 half_way = normalize(to_eye + sun_direction);
    float n_h = max(dot(n, half_way), 0.0);
    float n_v = max(dot(n, to_eye), 0.05);
    float a2 = max(roughness * roughness * roughness * roughness, 1e-3);
    float q = n_h * n_h * (a2 - 1.0) + 1.0;
    float spread = a2 / (3.14159265 * q * q);
    float k = 0.5 * roughness * roughness;
    float seen = 1.0 / (4.0 * mix(n_v, 1.0, k) * mix(max(n_l, 0.05), 1.0, k));
    float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(half_way, to_eye), 0.0), 5.0);
    vec3 sun_light = light_strength.x * vec3(2.55, 2.38, 2.08) * sun * n_l;
    vec3 sky = mix(vec3(0.30, 0.26, 0.22), vec3(0.62, 0.74, 0.92), 0.5 + 0.5 * n.y);
    vec3 sky_light = light_strength.y * sky * open;
    float rim = 0.04 + (1.0 - roughness) * 0.5 * pow(1.0 - n_v, 5.0);
    return albedo * (sun_light + sky_light) + sun_light * (spread * seen * fresnel) +
           sky_light * (1.0 - roughness) * rim;
}

// Light to what a screen shows: straight in the darks, bent in the lights so that none clip.
vec3 shown(vec3 light) {
    vec3 x = light * 0.82;
    return clamp(x * (1.0 + x * 0.16) / (1.0 + x * 0.52), 0.0, 1.0);
}

// Wide patches of brightness, 0 to 1, so that repeated pictures do not show their period.
uniform float patch_size;
float patches(vec2 at) {
    return 0.6 * lattice_noise(at / patch_size) + 0.4 * lattice_noise(at * 2.7 / patch_size);
}
)glsl";
}

std::string_view noise_glsl() {
    return R"glsl(
float lattice_noise(vec2 at) {
    vec2 cell = floor(at);
    vec2 f = at - cell;
    f = f * f * (3.0 - 2.0 * f);
    uvec2 i = uvec2(ivec2(cell) + 32768);
    vec4 v;
    for (uint k = 0u; k < 4u; ++k) {
        uint h = (i.x + (k & 1u)) * 73856093u ^ (i.y + (k >> 1u)) * 19349663u;
        h = (h ^ (h >> 13)) * 1274126177u;
        v[k] = float((h ^ (h >> 16)) & 65535u) / 65535.0;
    }
    return mix(mix(v.x, v.y, f.x), mix(v.z, v.w, f.x), f.y);
}
)glsl";
}

}  // namespace scree::terrain
