#include "terrain/view/view_shaders.h"

#include "terrain/view/light_shaders.h"

namespace scree::terrain {
namespace {

constexpr const char* kVersion = "#version 450 core\n";

constexpr const char* kCells = R"glsl(
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D base_heights;
layout(binding = 1) uniform sampler2D moved_heights;
uniform ivec2 window_origin;  // the cells to fill
uniform ivec2 window_size;
uniform float cell_size;

float height_of(ivec2 cell) {
    ivec2 c = clamp(cell, ivec2(0), textureSize(base_heights, 0) - 1);
    return texelFetch(base_heights, c, 0).r + texelFetch(moved_heights, c, 0).r;
}
)glsl";

constexpr const char* kSurface = R"glsl(
layout(binding = 0, rgba16f) writeonly uniform image2D surface;

float moved(ivec2 cell) {
    return texelFetch(moved_heights, clamp(cell, ivec2(0), textureSize(moved_heights, 0) - 1), 0).r;
}

// Central differences, one-sided at the rim (rocks-and-deformer.md C.12).
vec2 slopes(float w, float e, float n, float s, ivec2 cell) {
    ivec2 last = textureSize(base_heights, 0) - 1;
    vec2 span = vec2(cell.x == 0 || cell.x == last.x ? 1.0 : 2.0,
                     cell.y == 0 || cell.y == last.y ? 1.0 : 2.0);
    return vec2(e - w, s - n) / (span * cell_size);
}

// Share of the sky that the ground around leaves open, by its horizon in eight directions.
float open_sky(ivec2 cell, float height) {
    const float steps[4] = float[4](1.5, 4.0, 9.0, 20.0);
    float closed = 0.0;
    for (int i = 0; i < 8; ++i) {
        float angle = 0.7853982 * (float(i) + 0.5);
        vec2 direction = vec2(cos(angle), sin(angle));
        float steepest = 0.0;
        for (int k = 0; k < 4; ++k) {
            float rise = height_of(cell + ivec2(round(direction * steps[k]))) - height;
            steepest = max(steepest, rise / (steps[k] * cell_size));
        }
        closed += steepest / sqrt(1.0 + steepest * steepest);
    }
    return 1.0 - closed / 8.0;
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, window_size)))
        return;
    ivec2 c = window_origin + local;
    vec2 total = slopes(height_of(c + ivec2(-1, 0)), height_of(c + ivec2(1, 0)),
                        height_of(c + ivec2(0, -1)), height_of(c + ivec2(0, 1)), c);
    vec2 change = slopes(moved(c + ivec2(-1, 0)), moved(c + ivec2(1, 0)),
                         moved(c + ivec2(0, -1)), moved(c + ivec2(0, 1)), c);
    float share = 0.5 * clamp(length(change) / 0.1, 0.0, 1.0);
    imageStore(surface, c, vec4(total, share, open_sky(c, height_of(c))));
}
)glsl";

constexpr const char* kSun = R"glsl(
layout(binding = 0, r8) writeonly uniform image2D sun_reach;
uniform vec3 sun_direction;
uniform float highest;  // of the ground, metres

float height_between(vec2 cell) {
    vec2 low = floor(cell);
    vec2 f = cell - low;
    ivec2 i = ivec2(low);
    return mix(mix(height_of(i), height_of(i + ivec2(1, 0)), f.x),
               mix(height_of(i + ivec2(0, 1)), height_of(i + ivec2(1, 1)), f.x), f.y);
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, window_size)))
        return;
    ivec2 c = window_origin + local;
    float flat_length = length(sun_direction.xz);
    float lit = 1.0;
    if (flat_length > 0.02) {
        vec2 step_direction = sun_direction.xz / flat_length;
        float rise = sun_direction.y / flat_length;
        float start = height_of(c) + 0.05 * cell_size;
        float along = 1.0;
        vec2 rim = vec2(textureSize(base_heights, 0) - 1);
        for (int i = 0; i < 96; ++i) {
            vec2 at = vec2(c) + step_direction * along;
            float ray = start + along * cell_size * rise;
            if (ray > highest || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, rim)))
                break;
            float clear = (ray - height_between(at)) / (along * cell_size);
            lit = min(lit, 0.5 + clear / 0.08);
            if (lit <= 0.0)
                break;
            along += max(1.0, along * 0.06);
        }
    }
    imageStore(sun_reach, c, vec4(clamp(lit, 0.0, 1.0)));
}
)glsl";

constexpr const char* kWallVertex = R"glsl(
layout(binding = 0) uniform sampler2D base_heights;
layout(binding = 1) uniform sampler2D moved_heights;
layout(location = 0) in vec4 wall;  // x, z, 1 at the top or 0 at the foot, side 0 to 3
out vec3 world;
flat out vec3 face;
uniform vec2 ground_origin;
uniform vec2 per_ground_size;
uniform float foot;
uniform mat4 clip_from_world;

void main() {
    const vec3 faces[4] = vec3[4](vec3(0, 0, -1), vec3(1, 0, 0), vec3(0, 0, 1), vec3(-1, 0, 0));
    vec2 uv = (wall.xy - ground_origin) * per_ground_size;
    float top = textureLod(base_heights, uv, 0.0).r + textureLod(moved_heights, uv, 0.0).r;
    world = vec3(wall.x, mix(foot, top, wall.z), wall.y);
    face = faces[int(wall.w)];
    gl_Position = clip_from_world * vec4(world, 1.0);
}
)glsl";

constexpr const char* kObjectVertex = R"glsl(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
out vec3 world;
out vec3 shading_normal;
uniform mat4 world_from_object;
uniform mat4 normal_from_object;
uniform mat4 clip_from_world;

void main() {
    vec4 at = world_from_object * vec4(position, 1.0);
    world = at.xyz;
    shading_normal = (normal_from_object * vec4(normal, 0.0)).xyz;
    gl_Position = clip_from_world * at;
}
)glsl";

constexpr const char* kObjectFragment = R"glsl(
in vec3 world;
in vec3 shading_normal;
layout(location = 0) out vec4 picture;
layout(binding = 0) uniform sampler2D base_heights;
layout(binding = 1) uniform sampler2D moved_heights;
layout(binding = 3) uniform sampler2D sun_reach;
uniform vec2 ground_origin;
uniform vec2 per_ground_size;
uniform vec3 object_colour;
uniform float object_roughness;
uniform float object_size;
uniform float normal_reach;

void main() {
    vec3 n = normalize(shading_normal);
    vec2 uv = (world.xz - ground_origin) * per_ground_size;
    bool over = all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
    float clearance = over ? world.y - texture(base_heights, uv).r - texture(moved_heights, uv).r
                           : object_size;
    // Ground takes the sky from what stands on it and faces down.
    float closeness = exp(-max(clearance, 0.0) / (0.25 * object_size));
    float open = 1.0 - closeness * (0.35 + 0.35 * clamp(-n.y, 0.0, 1.0));
    float sun = object_shadow(world + n * normal_reach);
    vec3 colour = lit_colour(object_colour, n, open, sun, object_roughness, world);
    picture = vec4(shown(colour), 1.0);
}
)glsl";

constexpr const char* kShadowVertex = R"glsl(
layout(location = 0) in vec3 position;
uniform mat4 shadow_from_object;
void main() { gl_Position = shadow_from_object * vec4(position, 1.0); }
)glsl";

constexpr const char* kScreenVertex = R"glsl(
out vec2 across;
void main() {
    across = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    gl_Position = vec4(across * 2.0 - 1.0, 1.0, 1.0);
}
)glsl";

// The mean, in linear light, of the samples of a pixel.
constexpr const char* kResolveFragment = R"glsl(
layout(location = 0) out vec4 picture;
layout(binding = 0) uniform sampler2D samples;
uniform int along;
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * along;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < along; ++y)
        for (int x = 0; x < along; ++x)
            sum += texelFetch(samples, first + ivec2(x, y), 0).rgb;
    picture = vec4(sum / float(along * along), 1.0);
}
)glsl";

constexpr const char* kLineFragment = R"glsl(
layout(location = 0) out vec4 picture;
void main() { picture = vec4(0.012, 0.016, 0.022, 1.0); }
)glsl";

}  // namespace

std::string surface_compute_glsl() {
    return std::string(kVersion) + kCells + kSurface;
}
std::string sun_compute_glsl() {
    return std::string(kVersion) + kCells + kSun;
}
std::string wall_vertex_glsl() {
    return std::string(kVersion) + kWallVertex;
}
std::string object_vertex_glsl() {
    return std::string(kVersion) + kObjectVertex;
}
std::string object_fragment_glsl() {
    return kVersion + std::string(noise_glsl()) + std::string(light_glsl()) + kObjectFragment;
}
std::string shadow_vertex_glsl() {
    return std::string(kVersion) + kShadowVertex;
}
std::string shadow_fragment_glsl() {
    return std::string(kVersion) + "void main() {}\n";
}
std::string screen_vertex_glsl() {
    return std::string(kVersion) + kScreenVertex;
}
std::string resolve_fragment_glsl() {
    return std::string(kVersion) + kResolveFragment;
}
std::string line_fragment_glsl() {
    return std::string(kVersion) + kLineFragment;
}

}  // namespace scree::terrain
