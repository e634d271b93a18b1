#include "terrain/view/light_shaders.h"
#include "terrain/view/look_shaders.h"
#include "terrain/view/ranges.h"
#include "terrain/view/tessellation.h"
#include "terrain/view/view_shaders.h"

namespace scree::terrain {
namespace {

constexpr const char* kVersion = "#version 450 core\n";

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
uniform vec3 eye;
uniform float far_m;
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

// Beyond r2 nothing is displaced, so nothing is cut. An edge goes by its own two ends, which both of
// its patches see alike.
void leave_far_ground_whole(vec3 p[6], inout vec4 factors) {
    bvec3 beyond = bvec3(distance(eye, p[0]) > far_m, distance(eye, p[1]) > far_m,
                         distance(eye, p[2]) > far_m);
    for (int edge = 0; edge < 3; ++edge)
        if (beyond[(edge + 1) % 3] && beyond[(edge + 2) % 3])
            factors[edge] = 1.0;
    if (all(beyond))
        factors.w = 1.0;
}

void main() {
    corner_place[gl_InvocationID] = lattice_point[gl_InvocationID].xz;
    if (gl_InvocationID != 0)
        return;
    vec3 p[6] = vec3[6](lattice_point[0], lattice_point[1], lattice_point[2], lattice_point[3],
                        lattice_point[4], lattice_point[5]);
    vec4 factors = patch_factors(p, reference, per_radius2, amount);
    leave_far_ground_whole(p, factors);
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

constexpr const char* kEvaluation = R"glsl(
layout(triangles, fractional_odd_spacing, ccw) in;
in vec2 corner_place[];

uniform mat4 clip_from_world;
uniform vec3 eye;
uniform float near_m;
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

// Where rocks are meshes, the picture of their heights is not raised too.
float detail_height(vec2 at, float part_length, float as_meshes) {
    ScreeBlend blend = scree_blend(torn(at));
    float height = 0.0;
    for (int i = 0; i < SCREE_SHARES; ++i) {
        if (blend.weights[i] <= 0.0)
            continue;
        float lod = log2(max(1.0, part_length * detail_texels / SCREE_SIZE[blend.slots[i]]));
        float raised = 1.0 - as_meshes * looks[blend.slots[i]].kind.x;
        height += blend.weights[i] * raised * scree_displacement_of(blend.slots[i], at, lod);
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
    float as_meshes = range_share(distance(eye, place), near_m);
    float near = range_share(distance(eye, place), far_m);
    float height = base;
    if (near > 0.0)
        height += near * (textureLod(moved_heights, uv, 0.0).r +
                          rim * detail_height(at, part_length(place), as_meshes));
    gl_Position = clip_from_world * vec4(at.x, height, at.y, 1.0);
}
)glsl";

}  // namespace

std::string ground_vertex_glsl() {
    return std::string(kVersion) + std::string(heights_glsl()) + kVertex;
}

std::string ground_control_glsl() {
    return kVersion + std::string(tessellation_glsl()) + kControl;
}

std::string ground_evaluation_glsl(const GroundShaders& made) {
    return kVersion + std::string(ranges_glsl()) + std::string(tessellation_glsl()) +
           std::string(noise_glsl()) + std::string(heights_glsl()) + made.evaluation_functions +
           std::string(looks_glsl()) + kEvaluation;
}

}  // namespace scree::terrain
