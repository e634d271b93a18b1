#include "terrain/gpu/deformer_shaders.h"

namespace scree::terrain {
namespace {

// What both kernels share. The arithmetic follows terrain/grid/face_flux.h operation by operation;
// `precise` forbids the compiler to fuse or reorder it.
constexpr const char* kShared = R"glsl(
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D base_heights;
layout(binding = 1) uniform sampler2D moved_heights;
layout(binding = 0, r32f) writeonly uniform image2D moved_next;
layout(std430, binding = 1) buffer Report {
    uint greatest_move;   // bits of a float, metres
    uint compacted_low;   // quanta, 64 bits
    uint compacted_high;
};

uniform float time_step;
uniform float cell_size;
uniform float per_cell_size;
uniform float gain;
uniform float quantum;
uniform int keep_base;
uniform int zero_border;

// Of a cell: tangent of repose (or its angle, where the slide is weighted), diffusion, mobility,
// compaction.
#ifdef PALETTE
layout(std430, binding = 0) readonly buffer Soils { vec4 soils[]; };
layout(binding = 2) uniform usampler2D soil_index;
vec4 soil_of(ivec2 c) { return soils[texelFetch(soil_index, c, 0).r]; }
#else
layout(binding = 2) uniform sampler2D soil_cells;
vec4 soil_of(ivec2 c) { return texelFetch(soil_cells, c, 0); }
#endif

ivec2 extent() { return textureSize(base_heights, 0); }
bool inside(ivec2 c) { return all(greaterThanEqual(c, ivec2(0))) && all(lessThan(c, extent())); }
bool stays(ivec2 c) {
    return zero_border != 0 &&
           (any(equal(c, ivec2(0))) || any(equal(c, extent() - 1)));
}

float quantised(float amount) {
    precise float shift = quantum * 8388608.0;
    precise float lowered = amount + (shift - 0.5 * quantum);
    precise float result = max(lowered, shift) - shift;
    return result;
}

float arctangent(float tangent) {
    bool steep = tangent > 1.0;
    precise float x = steep ? 1.0 / tangent : tangent;
    precise float z = x * x;
    precise float sum = -0.00455979199;
    sum = sum * z + 0.0237805186;
    sum = sum * z - 0.0588297531;
    sum = sum * z + 0.0986886546;
    sum = sum * z - 0.140032902;
    sum = sum * z + 0.199669618;
    sum = sum * z - 0.333318127;
    sum = sum * z + 0.999999882;
    precise float angle = sum * x;
    precise float steep_angle = 1.57079633 - angle;
    return steep ? steep_angle : angle;
}

float face_diffusion(float a, float b) {
    precise float sum = a + b;
    precise float mean = 2.0 * a * b / sum;
    return sum > 0.0 ? mean : 0.0;
}

// What a cell gains by slides through the face to a neighbour (C.8), metres.
float slide(float base_here, float base_there, float moved_here, float moved_there, vec2 soil_here,
            vec2 soil_there) {
    precise float base_difference = base_there - base_here;
    precise float moved_difference = moved_there - moved_here;
    precise float difference = base_difference + moved_difference;
    bool from_there = difference > 0.0;
    float repose = from_there ? soil_there.x : soil_here.x;
    float held = keep_base != 0 ? abs(base_difference) : 0.0;
    precise float diffusion = face_diffusion(soil_here.y, soil_there.y) * time_step;
#ifdef WEIGHTED
    precise float size = abs(difference);
    float angle = arctangent(size * per_cell_size);
    float holds = max(repose, arctangent(held * per_cell_size));
    precise float room = max(1.57079633 - holds, 1e-6);
    precise float raw = gain * (angle - holds) / room;
    float weight = min(max(raw, 0.0), 1.0);
    precise float amount = diffusion * (weight * size);
    float quanta = quantised(amount);
#else
    precise float threshold = repose * cell_size;
    precise float holds = max(threshold, held) * diffusion;
    precise float shift = quantum * 8388608.0;
    precise float least = (shift - 0.5 * quantum) - (holds + 0.25 * quantum);
    precise float raw = abs(difference) * diffusion;
    precise float lowered = raw + least;
    precise float quanta = max(lowered, shift) - shift;
#endif
    return from_there ? quanta : -quanta;
}

shared uint group_move;

// Take part in the group's greatest move; every invocation calls it.
void note_move(float move) {
    if (gl_LocalInvocationIndex == 0u)
        group_move = 0u;
    barrier();
    atomicMax(group_move, floatBitsToUint(move));
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_move != 0u)
        atomicMax(greatest_move, group_move);
}
)glsl";

constexpr const char* kTiles = R"glsl(
const int kTile = 16;
const int kMostIterations = 4;
const int kSide = kTile + 2 * kMostIterations;

uniform int iterations;

shared float tile_base[kSide * kSide];
shared float tile_moved[2][kSide * kSide];
shared vec2 tile_soil[kSide * kSide];

float flow(int here, int there, int source) {
    return slide(tile_base[here], tile_base[there], tile_moved[source][here],
                 tile_moved[source][there], tile_soil[here], tile_soil[there]);
}

void main() {
    int side = kTile + 2 * iterations;
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile - iterations;
    int first = int(gl_LocalInvocationIndex);
    for (int i = first; i < side * side; i += kTile * kTile) {
        ivec2 c = corner + ivec2(i % side, i / side);
        if (!inside(c))
            continue;
        tile_base[i] = texelFetch(base_heights, c, 0).r;
        tile_moved[0][i] = texelFetch(moved_heights, c, 0).r;
        tile_soil[i] = soil_of(c).xy;
    }
    barrier();
    // Each iteration is right one ring further in: what the halo lacked never reaches the tile.
    for (int k = 0; k < iterations; ++k) {
        int source = k & 1;
        for (int i = first; i < side * side; i += kTile * kTile) {
            ivec2 local = ivec2(i % side, i / side);
            ivec2 c = corner + local;
            if (any(lessThanEqual(local, ivec2(k))) ||
                any(greaterThanEqual(local, ivec2(side - 1 - k))) || !inside(c))
                continue;
            float east = inside(c + ivec2(1, 0)) ? flow(i, i + 1, source) : 0.0;
            float west = inside(c - ivec2(1, 0)) ? flow(i, i - 1, source) : 0.0;
            float south = inside(c + ivec2(0, 1)) ? flow(i, i + side, source) : 0.0;
            float north = inside(c - ivec2(0, 1)) ? flow(i, i - side, source) : 0.0;
            precise float next = tile_moved[source][i] + ((east + west) + (south + north));
            tile_moved[1 - source][i] = stays(c) ? 0.0 : next;
        }
        barrier();
    }
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + iterations;
    ivec2 c = corner + local;
    int i = local.y * side + local.x;
    float move = 0.0;
    if (inside(c)) {
        float now = tile_moved[iterations & 1][i];
        move = abs(now - texelFetch(moved_heights, c, 0).r);
        imageStore(moved_next, c, vec4(now));
    }
    note_move(move);
}
)glsl";

constexpr const char* kLoads = R"glsl(
layout(binding = 3) uniform sampler2D loads;  // force x, force z, underside
uniform ivec4 load_window;                    // corner and size

bool loaded(ivec2 c) {
    return all(greaterThanEqual(c, load_window.xy)) &&
           all(lessThan(c, load_window.xy + load_window.zw));
}

vec3 load_at(ivec2 c) {
    return loaded(c) ? texelFetch(loads, c - load_window.xy, 0).rgb
                     : vec3(0.0, 0.0, uintBitsToFloat(0x7f800000u));
}

float moved(ivec2 c) { return texelFetch(moved_heights, c, 0).r; }
float base(ivec2 c) { return texelFetch(base_heights, c, 0).r; }

float penetration(ivec2 c) {
    precise float depth = (base(c) + moved(c)) - load_at(c).z;
    return max(depth, 0.0);
}

float compacted(ivec2 c) {
    if (stays(c))
        return 0.0;
    vec4 soil = soil_of(c);
    precise float share = soil.w * soil.z * time_step;
    precise float pressed = min(share, 1.0) * penetration(c);
    return quantised(pressed);
}

// What the load would push from a cell into a neighbour, were there no limiter (C.9).
float outflow(ivec2 c, ivec2 to) {
    ivec2 n = c + to;
    if (!inside(n))
        return 0.0;
    precise float mobility = (soil_of(c).z + soil_of(n).z) * 0.5;
    vec2 forces = to.x != 0 ? vec2(load_at(c).x, load_at(n).x) : vec2(load_at(c).y, load_at(n).y);
    precise float force = (forces.x + forces.y) * 0.5;
    precise float out_ = float(to.x + to.y) * (mobility * force) * (time_step * cell_size);
    return max(out_, 0.0);
}

float pushed(ivec2 c, ivec2 to) {
    precise float all_ = (outflow(c, ivec2(1, 0)) + outflow(c, ivec2(-1, 0))) +
                         (outflow(c, ivec2(0, 1)) + outflow(c, ivec2(0, -1)));
    precise float room = penetration(c) - compacted(c);
    precise float share = all_ > room ? room / all_ : 1.0;
    precise float amount = outflow(c, to) * share;
    return quantised(amount);
}

float gain_from(ivec2 c, ivec2 to, bool near_load) {
    ivec2 n = c + to;
    if (!inside(n))
        return 0.0;
    float slid = slide(base(c), base(n), moved(c), moved(n), soil_of(c).xy, soil_of(n).xy);
    if (!near_load)
        return slid;
    precise float sum = slid - pushed(c, to) + pushed(n, -to);
    return sum;
}

void main() {
    ivec2 c = ivec2(gl_GlobalInvocationID.xy);
    float move = 0.0;
    if (inside(c)) {
        // Forces act on faces, so they reach one cell beyond the window.
        bool near_load = all(greaterThanEqual(c, load_window.xy - 2)) &&
                         all(lessThan(c, load_window.xy + load_window.zw + 2));
        precise float sideways = gain_from(c, ivec2(1, 0), near_load) +
                                 gain_from(c, ivec2(-1, 0), near_load);
        precise float lengthways = gain_from(c, ivec2(0, 1), near_load) +
                                   gain_from(c, ivec2(0, -1), near_load);
        float pressed = near_load ? compacted(c) : 0.0;
        float before = moved(c);
        precise float next = before + ((sideways + lengthways) - pressed);
        if (stays(c))
            next = 0.0;
        imageStore(moved_next, c, vec4(next));
        move = abs(next - before);
        if (pressed > 0.0) {
            uint quanta = uint(pressed / quantum + 0.5);
            uint old = atomicAdd(compacted_low, quanta);
            if (old + quanta < old)
                atomicAdd(compacted_high, 1u);
        }
    }
    note_move(move);
}
)glsl";

// (4.10) with (4.9) or (4.13), operation by operation as terrain/grid/literal_terms.h has it: here
// `moved_heights` are base and displacement as one height.
constexpr const char* kLiteral = R"glsl(
layout(binding = 3) uniform sampler2D loads;  // force x, force z
uniform ivec4 load_window;
uniform float to_grid;
uniform float push_scale;     // sign, 1/2 and cell size
uniform int clamp_weights;
uniform int chain_rule;

ivec2 held(ivec2 c) { return clamp(c, ivec2(0), extent() - 1); }
float height_at(ivec2 c) { return texelFetch(moved_heights, held(c), 0).r; }

float force_at(ivec2 c, ivec2 axis) {
    if (!inside(c) || any(lessThan(c, load_window.xy)) ||
        any(greaterThanEqual(c, load_window.xy + load_window.zw)))
        return 0.0;
    vec2 force = texelFetch(loads, c - load_window.xy, 0).rg;
    return axis.x != 0 ? force.x : force.y;
}

float arctangent_of_root(float a) {
    precise float z = min(a, 1.0 / max(a, 1.0));
    precise float sum = 0.00764835393;
    sum = sum * z - 0.0363604309;
    sum = sum * z + 0.083126453;
    sum = sum * z - 0.134478641;
    sum = sum * z + 0.198720403;
    sum = sum * z - 0.33325678;
    precise float angle = (sum * z + 0.999999226) * sqrt(z);
    precise float steep_angle = 1.57079633 - angle;
    return a > 1.0 ? steep_angle : angle;
}

float push(float before, float after, float mobility) {
    precise float amount = push_scale * (mobility * (after - before));
    return amount;
}

float term(ivec2 c, ivec2 axis) {
    float here = height_at(c);
    vec4 soil = soil_of(c);
    precise float diffused = soil.y * ((height_at(c - axis) + height_at(c + axis)) - 2.0 * here);
    precise float sum = diffused + push(force_at(c - axis, axis), force_at(c + axis, axis), soil.z);
    if (chain_rule != 0) {
        vec4 after = soil_of(held(c + axis));
        precise float crossed = (height_at(c + axis) - here) * (after.y - soil.y);
        sum += crossed;
        sum += push(soil_of(held(c - axis)).z, after.z, force_at(c, axis));
    }
    return sum;
}

float weighted(float one, float repose, float per_room) {
    precise float weight = (arctangent_of_root(abs(one) * to_grid) - repose) * per_room;
    precise float product = (clamp_weights != 0 ? min(max(weight, 0.0), 1.0) : weight) * one;
    return product;
}

void main() {
    ivec2 c = ivec2(gl_GlobalInvocationID.xy);
    float move = 0.0;
    if (inside(c)) {
        float repose = soil_of(c).x;
        precise float per_room = 1.0 / max(1.57079633 - repose, 1e-6);
        precise float sum = weighted(term(c, ivec2(1, 0)), repose, per_room) +
                            weighted(term(c, ivec2(0, 1)), repose, per_room);
        float before = height_at(c);
        precise float next = before + time_step * sum;
        if (stays(c))
            next = texelFetch(base_heights, c, 0).r;  // (4.7)
        imageStore(moved_next, c, vec4(next));
        move = abs(next - before);
    }
    note_move(move);
}
)glsl";

std::string header(const DeformerShaderForm& form) {
    std::string text = "#version 450 core\n";
    if (form.weighted)
        text += "#define WEIGHTED\n";
    if (form.palette)
        text += "#define PALETTE\n";
    return text;
}

}  // namespace

std::string sound_tiles_glsl(const DeformerShaderForm& form) {
    return header(form) + kShared + kTiles;
}

std::string sound_loads_glsl(const DeformerShaderForm& form) {
    return header(form) + kShared + kLoads;
}

std::string literal_glsl(const DeformerShaderForm& form) {
    return header(form) + kShared + kLiteral;
}

}  // namespace scree::terrain
