#include "terrain/view/dynamic_normals.h"
#include "terrain/view/light_shaders.h"
#include "terrain/view/look_shaders.h"
#include "terrain/view/ranges.h"
#include "terrain/view/view_shaders.h"

namespace scree::terrain {
namespace {

constexpr const char* kVersion = "#version 450 core\n";

// Ground is shaded once for every sample of the picture, from its depth: small triangles would
// otherwise be shaded many times over.
constexpr const char* kFragment = R"glsl(
in vec2 across;
layout(location = 0) out vec4 picture;
layout(binding = 8) uniform sampler2D scene_depth;
layout(binding = 9) uniform sampler2D undersides;  // of the objects, seen from below
uniform vec4 under_area;      // corner, 1 / size; metres
uniform vec2 under_range;     // least height, span; metres
uniform float under_size;     // of the objects, metres; 0: there are none
uniform mat4 world_from_clip;
uniform vec2 sample_size;     // of the picture, in clip space

layout(binding = 2) uniform sampler2D surface;
layout(binding = 6) uniform sampler2DArray detail;
layout(binding = 3) uniform sampler2D sun_reach;
uniform int mode;             // 0 textured, 1 wire, 2 height, 3 material
uniform vec3 height_scale;    // least height, 1 / span, contour interval; metres
uniform float cell_size;
uniform float near_m;         // within it gravel is rocks, not pictures of them

struct Soil {
    vec3 albedo;
    vec2 slopes;
    float open;       // sky that the detail leaves open
    float roughness;
    float lit;        // sun that the detail lets through
};

// Sun past the grains: a few steps towards it through the picture of heights.
float grain_sun(vec2 uv, float layer, Look look, float height) {
    if (look.measure.y <= 0.0 || sun_direction.y > 0.97)
        return 1.0;
    vec2 to_sun = normalize(sun_direction.xz);
    float rise = sun_direction.y / length(sun_direction.xz);
    float reach = 1.2 * look.measure.y / max(rise, 0.2);
    float lit = 1.0;
    for (int i = 1; i <= 3; ++i) {
        float along = reach * float(i) / 3.0;
        float other = texture(detail, vec3(uv + to_sun * along * look.measure.x, layer)).b;
        float over = (other - height) * look.measure.y - along * rise;
        lit = min(lit, 1.0 - clamp(over / (0.12 * look.measure.y), 0.0, 1.0));
    }
    return lit;
}

// A place on the ground and the footprint of a sample on it, as the pictures are laid over it. An
// oblong footprint takes two or four rounder look-ups along its length, so that ground seen at a
// slant keeps its detail.
struct Laid {
    vec2 at, piece, shorter;
    int n;
    float share;
};

Laid laid(vec2 at, vec2 dx, vec2 dy, float share) {
    float x2 = dot(dx, dx);
    float y2 = dot(dy, dy);
    vec2 longer = x2 > y2 ? dx : dy;
    vec2 shorter = x2 > y2 ? dy : dx;
    float oblong = max(x2, y2) / max(min(x2, y2), 1e-30);
    int n = oblong < 3.0 ? 1 : oblong < 12.0 ? 2 : 4;
    return Laid(at, longer / float(n), shorter, n, share);
}

vec2 tap(Laid on, int i) { return on.at + on.piece * (float(i) - 0.5 * float(on.n - 1)); }

// The pictures lie flat on the ground; on steep sides, where they would be drawn out, they give
// place to the same pictures seen from the side.
void lay(vec3 world, vec3 dx, vec3 dy, vec2 slopes, out Laid flat_, out Laid side) {
    float steep = smoothstep(0.9, 1.7, length(slopes));
    flat_ = laid(world.xz, dx.xz, dy.xz, 1.0 - steep);
    side = abs(slopes.x) > abs(slopes.y) ? laid(world.yz, dx.yz, dy.yz, steep)
                                         : laid(world.xy, dx.xy, dy.xy, steep);
}

vec3 albedo_on(int slot, Laid on) {
    if (on.share <= 0.0)
        return vec3(0.0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < on.n; ++i)
        sum += scree_albedo_of(slot, tap(on, i), on.piece, on.shorter);
    return sum * (on.share / float(on.n));
}

vec4 detail_on(int slot, float per_size, Laid on) {
    if (on.share <= 0.0)
        return vec4(0.0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < on.n; ++i)
        sum += textureGrad(detail, vec3(tap(on, i) * per_size, float(slot)), on.piece * per_size,
                           on.shorter * per_size);
    return sum * (on.share / float(on.n));
}

Soil soil_at(vec3 world, float base, vec3 dx, vec3 dy, vec2 slopes) {
    Laid flat_, side;
    lay(world, dx, dy, slopes, flat_, side);
    ScreeBlend blend = scree_blend(torn(world.xz));
    float as_meshes = range_share(distance(eye, vec3(world.x, base, world.z)), near_m);
    Soil soil = Soil(vec3(0.0), vec2(0.0), 0.0, 0.0, 0.0);
    float total = 0.0;
    for (int i = 0; i < SCREE_SHARES; ++i) {
        float w = blend.weights[i];
        if (w <= 0.0)
            continue;
        int slot = blend.slots[i];
        Look look = looks[slot];
        vec4 d = detail_on(slot, look.measure.x, flat_) + detail_on(slot, look.measure.x, side);
        if (w < 1.0)  // what stands higher covers what lies lower
            w *= exp2(7.0 * (d.b - 0.5) * step(1e-9, look.measure.y));
        total += w;
        soil.albedo += w * (albedo_on(slot, flat_) + albedo_on(slot, side));
        float raised = 1.0 - as_meshes * look.kind.x;
        soil.slopes += w * raised * (d.rg * 2.0 - 256.0 / 255.0) * look.measure.z;
        soil.open += w * mix(1.0, d.a, raised);
        soil.roughness += w * look.colour.w;
        soil.lit += w * mix(1.0, grain_sun(world.xz * look.measure.x, float(slot), look, d.b), raised * flat_.share);
    }
    return Soil(soil.albedo / total, soil.slopes / total, soil.open / total,
                soil.roughness / total, soil.lit / total);
}

vec3 height_colour(float t) {
    const vec3 ramp[6] = vec3[6](vec3(0.09, 0.18, 0.34), vec3(0.13, 0.42, 0.45),
                                 vec3(0.36, 0.60, 0.40), vec3(0.78, 0.76, 0.46),
                                 vec3(0.80, 0.52, 0.30), vec3(0.95, 0.92, 0.88));
    float x = clamp(t, 0.0, 1.0) * 5.0;
    int i = min(int(x), 4);
    return 0.75 * pow(mix(ramp[i], ramp[i + 1], x - float(i)), vec3(1.7));
}

vec3 plain_colour(int layer) {
    float hue = fract(0.09 + float(layer) * 0.381966);
    vec3 c = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(0.5), c, 0.55) * 0.62;
}

float contour(float height, float interval, float change) {
    float x = height / interval;
    float width = change / interval;
    float line = abs(fract(x - 0.5) - 0.5) / max(width, 1e-6);
    return (1.0 - smoothstep(0.5, 1.5, line)) * (1.0 - smoothstep(0.35, 0.7, width));
}

vec3 backdrop() {
    vec3 high = vec3(0.30, 0.42, 0.56);
    vec3 low = vec3(0.66, 0.68, 0.68);
    vec2 off = across - vec2(0.5, 0.45);
    return mix(low, high, smoothstep(0.1, 1.0, across.y)) * (1.0 - 0.28 * dot(off, off));
}

vec3 unprojected(vec2 clip, float depth) {
    vec4 at = world_from_clip * vec4(clip, 2.0 * depth - 1.0, 1.0);
    return at.xyz / at.w;
}

// Share of the sky that objects above leave open, by their undersides around.
float open_below_objects(vec3 at) {
    if (under_size <= 0.0)
        return 1.0;
    float closed = 0.0;
    for (int i = 0; i < 8; ++i) {
        float angle = 2.3999632 * float(i);
        vec2 tap = at.xz + 0.07 * under_size * sqrt(float(i) + 0.5) * vec2(cos(angle), sin(angle));
        vec2 place = (tap - under_area.xy) * under_area.zw;
        if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, vec2(1.0))))
            continue;
        float depth = textureLod(undersides, place, 0.0).r;
        if (depth < 1.0)
            closed += exp(-max(under_range.x + depth * under_range.y - at.y, 0.0) / (0.22 * under_size));
    }
    return 1.0 - 0.8 * closed / 8.0;
}

// Where the eye's ray through a place of the picture meets the plane of a point, less the point.
vec3 step_on_plane(vec2 clip, vec3 point, vec3 n) {
    vec3 ray = unprojected(clip, 1.0) - eye;
    float facing = dot(n, ray);
    float away = dot(n, point - eye);
    return abs(facing) > 1e-6 ? eye + ray * clamp(away / facing, 0.0, 1.0) - point : vec3(0.0);
}

void main() {
    float depth = texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r;
    if (depth >= 1.0) {
        picture = vec4(backdrop(), 1.0);
        return;
    }
    vec2 clip = 2.0 * across - 1.0;
    vec3 world = unprojected(clip, depth);
    vec2 at = world.xz;
    vec2 uv = ground_uv(at);
    vec4 s = texture(surface, uv);
    vec3 dynamic = normal_of(s.xy);
    float height = texture(base_heights, uv).r + texture(moved_heights, uv).r;
    vec3 facing = dot(dynamic, eye - world) > 0.05 * distance(eye, world) ? dynamic : normalize(eye - world);
    vec3 dx = step_on_plane(clip + vec2(sample_size.x, 0.0), world, facing);
    vec3 dy = step_on_plane(clip + vec2(0.0, sample_size.y), world, facing);
    Soil soil = Soil(vec3(0.42), vec2(0.0), 1.0, 1.0, 1.0);
    if (mode == 0)
        soil = soil_at(world, texture(base_heights, uv).r, dx, dy, s.xy);
    else if (mode == 2)
        soil.albedo = height_colour((height - height_scale.x) * height_scale.y);
    else if (mode == 3) {
        ScreeBlend blend = scree_blend(torn(at));
        soil.albedo = vec3(0.0);
        for (int i = 0; i < SCREE_SHARES; ++i)
            soil.albedo += blend.weights[i] * plain_colour(blend.slots[i]);
    }
    vec3 n = blend_normals(normal_of(s.xy + soil.slopes), dynamic, s.z);
    if (mode == 0)
        soil.albedo *= 0.90 + 0.2 * patches(at);
    float sun = texture(sun_reach, uv).r * soil.lit * object_shadow(world + dynamic * cell_size);
    vec3 colour = lit_colour(soil.albedo, n, s.w * soil.open * open_below_objects(world), sun, soil.roughness, world);
    if (mode == 2)
        colour = mix(colour, colour * 0.35,
                     contour(height, height_scale.z, abs(dx.y) + abs(dy.y)));
    picture = vec4(shown(colour), 1.0);
}
)glsl";

// A rock has the colours of the ground that its picture covered.
constexpr const char* kNearRock = R"glsl(
in vec3 world;
in vec3 shading_normal;
layout(location = 0) out vec4 picture;
uniform float normal_reach;

void main() {
    vec3 n = normalize(shading_normal);
    // Its neighbours take the sky from its sides.
    float open = 0.55 + 0.45 * clamp(n.y, 0.0, 1.0);
    vec3 albedo_ = scree_ground_colour(world.xz);
    picture = vec4(shown(lit_colour(albedo_, n, open, object_shadow(world + n * normal_reach), 0.9, world)), 1.0);
}
)glsl";

constexpr const char* kWall = R"glsl(
in vec3 world;
flat in vec3 face;
layout(location = 0) out vec4 picture;

// The ground's mean colour at a place: a footprint as wide as the pictures' last level.
vec3 mean_colour(vec2 at) {
    ScreeBlend blend = scree_blend(torn(at));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SCREE_SHARES; ++i) {
        float wide = 8.0 * SCREE_SIZE[blend.slots[i]];
        sum += blend.weights[i] * scree_albedo_of(blend.slots[i], vec2(0.0), vec2(wide, 0.0), vec2(0.0, wide));
    }
    return sum;
}

void main() {
    if (dot(face, eye - world) < 0.0)
        discard;
    vec2 along = vec2(dot(world.xz, face.zx), world.y);
    float layers = lattice_noise(vec2(along.x * 0.6, along.y * 9.0) / patch_size * 2.0);
    float grain = lattice_noise(along / patch_size * 60.0);
    float fade = clamp(1.0 - fwidth(along.x) / patch_size * 60.0, 0.0, 1.0);
    vec3 albedo_ = (0.6 * mean_colour(world.xz) + vec3(0.05, 0.04, 0.03)) *
                   (0.82 + 0.22 * layers + 0.16 * fade * (grain - 0.5));
    picture = vec4(shown(lit_colour(albedo_, face, 0.85, 1.0, 1.0, world)), 1.0);
}
)glsl";

}  // namespace

std::string near_rock_fragment_glsl(const GroundShaders& made) {
    return kVersion + std::string(noise_glsl()) + made.fragment_functions +
           std::string(light_glsl()) + kNearRock;
}

std::string ground_fragment_glsl(const GroundShaders& made) {
    return kVersion + std::string(ranges_glsl()) + std::string(dynamic_normals_glsl()) +
           std::string(noise_glsl()) + std::string(heights_glsl()) + made.fragment_functions +
           std::string(looks_glsl()) + std::string(light_glsl()) + kFragment;
}

std::string wall_fragment_glsl(const GroundShaders& made) {
    return kVersion + std::string(noise_glsl()) + made.fragment_functions +
           std::string(looks_glsl()) + std::string(light_glsl()) + kWall;
}

}  // namespace scree::terrain
