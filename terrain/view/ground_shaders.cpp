#include "terrain/view/dynamic_normals.h"
#include "terrain/view/light_shaders.h"
#include "terrain/view/ranges.h"
#include "terrain/view/tessellation.h"
#include "terrain/view/view_shaders.h"

namespace scree::terrain {
namespace {

constexpr const char* kVersion = "#version 450 core\n";

// Heights of the ground at a place in the world.
constexpr const char* kHeights = R"glsl(
layout(binding = 0) uniform sampler2D base_heights;
layout(binding = 1) uniform sampler2D moved_heights;
uniform vec2 ground_origin;   // corner of the window, metres
uniform vec2 per_ground_size; // 1 / its sides

vec2 ground_uv(vec2 at) { return (at - ground_origin) * per_ground_size; }
)glsl";

constexpr const char* kVertex = R"glsl(
layout(location = 0) in vec2 place;
out vec3 lattice_point;

void main() { lattice_point = vec3(place.x, textureLod(base_heights, ground_uv(place), 0.0).r, place.y); }
)glsl";

constexpr const char* kControl = R"glsl(
layout(vertices = 3) out;
in vec3 lattice_point[];
out vec2 corner_place[];

uniform vec3 reference;
uniform float per_radius2;
uniform float amount;
uniform float slack;          // how far displacement may carry a point, metres
uniform mat4 clip_from_world;

// All of a sphere lies beyond one side of the picture.
bool out_of_view(vec3 centre, float radius) {
    vec4 c = clip_from_world * vec4(centre, 1.0);
    for (int axis = 0; axis < 2; ++axis) {
        vec4 row = vec4(clip_from_world[0][axis], clip_from_world[1][axis],
                        clip_from_world[2][axis], clip_from_world[3][axis]);
        vec4 w = vec4(clip_from_world[0][3], clip_from_world[1][3], clip_from_world[2][3],
                      clip_from_world[3][3]);
        if (c.w + c[axis] < -radius * length((w + row).xyz) ||
            c.w - c[axis] < -radius * length((w - row).xyz))
            return true;
    }
    return false;
}

void main() {
    corner_place[gl_InvocationID] = lattice_point[gl_InvocationID].xz;
    if (gl_InvocationID != 0)
        return;
    vec3 p[6] = vec3[6](lattice_point[0], lattice_point[1], lattice_point[2], lattice_point[3],
                        lattice_point[4], lattice_point[5]);
    vec4 factors = patch_factors(p, reference, per_radius2, amount);
    vec3 centre = (p[0] + p[1] + p[2]) / 3.0;
    float reach = slack + max(distance(centre, p[0]), max(distance(centre, p[1]), distance(centre, p[2])));
    if (out_of_view(centre, reach))
        factors = vec4(0.0);
    gl_TessLevelOuter[0] = factors.x;
    gl_TessLevelOuter[1] = factors.y;
    gl_TessLevelOuter[2] = factors.z;
    gl_TessLevelInner[0] = factors.w;
}
)glsl";

// The looks that meet at a place: the four nearest cells of the map, weighted bilinearly; equal
// ones are looked up once (corner blend, rocks-and-deformer.md D.4). The place is moved by noise of
// half a cell, so that borders do not show the cells.
constexpr const char* kLooks = R"glsl(
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

constexpr const char* kEvaluation = R"glsl(
layout(triangles, fractional_odd_spacing, ccw) in;
in vec2 corner_place[];

uniform mat4 clip_from_world;
uniform vec3 eye;
uniform float far_m;
uniform float lattice_step;
uniform float detail_texels;  // side of the detail pictures

uniform vec3 reference;
uniform float per_radius2;
uniform float amount;

// Edge of the small triangles about a place, metres: from the place alone, not from the patch, or
// the two patches of an edge would look detail up in different levels and a crack would open.
float part_length(vec3 place) {
    return lattice_step / clamp(tessellation_weight(place, place, place, reference, per_radius2) * amount + 1.0, 1.0, 64.0);
}

float detail_height(vec2 at, float part_length) {
    Blend blend = corner_blend(at);
    float height = 0.0;
    for (int i = 0; i < 4; ++i) {
        if (blend.weight[i] <= 0.0)
            continue;
        Look look = looks[blend.layer[i]];
        float lod = log2(max(1.0, part_length * look.measure.x * detail_texels));
        float sampled = textureLod(detail, vec3(at * look.measure.x, float(blend.layer[i])), lod).b;
        height += blend.weight[i] * look.measure.y * (sampled - 0.5);
    }
    return height;
}

void main() {
    // Every edge is a sum of two terms here, so both of its patches get the same place.
    precise vec2 at = (gl_TessCoord.x * corner_place[0] + gl_TessCoord.y * corner_place[1]) +
                      gl_TessCoord.z * corner_place[2];
    vec2 uv = ground_uv(at);
    float base = textureLod(base_heights, uv, 0.0).r;
    vec3 place = vec3(at.x, base, at.y);
    // At the rim the ground meets its sides, which have no detail.
    vec2 inside = min(uv, 1.0 - uv) / per_ground_size;
    float rim = smoothstep(0.0, 1.0, min(inside.x, inside.y) / (0.5 * lattice_step));
    float near = range_share(distance(eye, place), far_m);
    float height = base;
    if (near > 0.0)
        height += near * (textureLod(moved_heights, uv, 0.0).r + rim * detail_height(at, part_length(place)));
    gl_Position = clip_from_world * vec4(at.x, height, at.y, 1.0);
}
)glsl";

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
layout(binding = 3) uniform sampler2D sun_reach;
uniform int mode;             // 0 textured, 1 wire, 2 height, 3 material
uniform vec3 height_scale;    // least height, 1 / span, contour interval; metres
uniform float cell_size;

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

// A look-up under an oblong footprint: two or four rounder ones along its length, so that ground seen
// at a slant keeps its detail.
vec4 sampled(sampler2DArray pictures, vec3 at, vec2 dx, vec2 dy) {
    float x2 = dot(dx, dx);
    float y2 = dot(dy, dy);
    vec2 longer = x2 > y2 ? dx : dy;
    vec2 shorter = x2 > y2 ? dy : dx;
    float oblong = max(x2, y2) / max(min(x2, y2), 1e-30);
    int n = oblong < 3.0 ? 1 : oblong < 12.0 ? 2 : 4;
    vec2 piece = longer / float(n);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec2 off = piece * (float(i) - 0.5 * float(n - 1));
        sum += textureGrad(pictures, at + vec3(off, 0.0), piece, shorter);
    }
    return sum / float(n);
}

Soil soil_at(vec2 at, vec2 dx, vec2 dy) {
    Blend blend = corner_blend(at);
    Soil soil = Soil(vec3(0.0), vec2(0.0), 0.0, 0.0, 0.0);
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        if (blend.weight[i] <= 0.0)
            continue;
        Look look = looks[blend.layer[i]];
        float layer = float(blend.layer[i]);
        vec2 uv = at * look.measure.x;
        vec4 d = sampled(detail, vec3(uv, layer), dx * look.measure.x, dy * look.measure.x);
        float w = blend.weight[i];
        if (w < 1.0)  // what stands higher covers what lies lower
            w *= exp2(7.0 * (d.b - 0.5) * step(1e-9, look.measure.y));
        total += w;
        vec3 colour = look.colour.rgb;
        if (look.measure.w > 0.5)
            colour = sampled(albedo, vec3(uv, layer), dx * look.measure.x, dy * look.measure.x).rgb;
        soil.albedo += w * colour;
        soil.slopes += w * (d.rg * 2.0 - 256.0 / 255.0) * look.measure.z;
        soil.open += w * d.a;
        soil.roughness += w * look.colour.w;
        soil.lit += w * grain_sun(uv, layer, look, d.b);
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

vec3 plain_colour(uint layer) {
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
        soil = soil_at(at, dx.xz, dy.xz);
    else if (mode == 2)
        soil.albedo = height_colour((height - height_scale.x) * height_scale.y);
    else if (mode == 3) {
        Blend blend = corner_blend(at);
        soil.albedo = vec3(0.0);
        for (int i = 0; i < 4; ++i)
            soil.albedo += blend.weight[i] * plain_colour(blend.layer[i]);
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

}  // namespace

std::string ground_vertex_glsl() {
    return std::string(kVersion) + kHeights + kVertex;
}

std::string ground_control_glsl() {
    return kVersion + std::string(tessellation_glsl()) + kControl;
}

std::string ground_evaluation_glsl() {
    return kVersion + std::string(ranges_glsl()) + std::string(tessellation_glsl()) +
           std::string(noise_glsl()) + kHeights + kLooks + kEvaluation;
}

std::string ground_fragment_glsl() {
    return kVersion + std::string(dynamic_normals_glsl()) + std::string(noise_glsl()) + kHeights +
           kLooks + std::string(light_glsl()) + kFragment;
}

}  // namespace scree::terrain
