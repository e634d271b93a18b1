#include "terrain/view/near_rocks.h"

#include "base/error.h"
#include "terrain/view/crease_normals.h"
#include "terrain/view/look_shaders.h"
#include "terrain/view/ranges.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

// A rock stands on the ground below its centre, and sinks into it towards r1, where the picture of
// its height has taken over.
constexpr const char* kVertex = R"glsl(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
struct Place {
    mat4 ground_from_rock;
    vec4 reach;
};
layout(std430, binding = 1) readonly buffer Places { Place places[]; };
out vec3 world;
out vec3 shading_normal;
uniform int first_place;
uniform vec3 eye;
uniform float near_m;
uniform mat4 clip_from_world;

void main() {
    Place place = places[first_place + gl_InstanceID];
    vec2 centre = place.ground_from_rock[3].xz;
    vec2 uv = ground_uv(centre);
    float base = textureLod(base_heights, uv, 0.0).r;
    float share = range_share(distance(eye, vec3(centre.x, base, centre.y)), near_m);
    world = (place.ground_from_rock * vec4(position, 1.0)).xyz;
    world.y += base + textureLod(moved_heights, uv, 0.0).r - (1.0 - share) * place.reach.x;
    // Rotation and even scale alone keep normals; a rock stretched a little is shaded well enough.
    shading_normal = mat3(place.ground_from_rock) * normal;
    bool over = all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
    gl_Position = share > 0.0 && over ? clip_from_world * vec4(world, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
}
)glsl";

bool is_finite(const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    return true;
}

/// How far a rock reaches above the ground, and from its centre aside.
glm::vec2 reach_of(const meshing::TriMesh& mesh, const glm::mat4& ground_from_rock) {
    glm::vec2 reach(0.0F);
    for (const glm::vec3& corner : mesh.positions) {
        const glm::vec4 from_centre = ground_from_rock * glm::vec4(corner, 0.0F);
        reach.x = std::max(reach.x, from_centre.y + ground_from_rock[3].y);
        reach.y = std::max(reach.y, std::hypot(from_centre.x, from_centre.z));
    }
    return reach;
}

}  // namespace

NearRocks::NearRocks(const GroundRocks& rocks) {
    std::vector<std::size_t> order(rocks.places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return rocks.places[a].mesh < rocks.places[b].mesh;
    });
    for (const std::size_t i : order) {
        const RockPlace& place = rocks.places[i];
        if (place.mesh >= rocks.meshes.size())
            fail<InvalidInput>("rock ", i, " is of mesh ", place.mesh, ", there are ",
                               rocks.meshes.size());
        if (!is_finite(place.ground_from_rock))
            fail<InvalidInput>("rock ", i, " has a place that is no finite number");
        const glm::vec2 reach = reach_of(rocks.meshes[place.mesh], place.ground_from_rock);
        places_.push_back({place.ground_from_rock, {reach, 0.0F, 0.0F}});
        mesh_of_.push_back(place.mesh);
    }
    if (places_.empty())
        return;
    std::vector<ShadedCorner> corners;
    for (const meshing::TriMesh& mesh : rocks.meshes) {
        const auto own = shaded_corners(mesh);
        meshes_.push_back({static_cast<int>(corners.size()), static_cast<int>(own.size())});
        corners.insert(corners.end(), own.begin(), own.end());
    }
    array_ = GlVertexArray(0U);
    corners_ = GlBuffer(0U);
    shown_ = GlBuffer(0U);
    glNamedBufferStorage(corners_.id(),
                         static_cast<GLsizeiptr>(corners.size() * sizeof(ShadedCorner)),
                         corners.data(), 0);
    glNamedBufferStorage(shown_.id(), static_cast<GLsizeiptr>(places_.size() * sizeof(Place)),
                         nullptr, GL_DYNAMIC_STORAGE_BIT);
    glVertexArrayVertexBuffer(array_.id(), 0, corners_.id(), 0, sizeof(ShadedCorner));
    for (const GLuint attribute : {0U, 1U}) {
        glEnableVertexArrayAttrib(array_.id(), attribute);
        glVertexArrayAttribFormat(array_.id(), attribute, 3, GL_FLOAT, GL_FALSE,
                                  attribute * static_cast<GLuint>(sizeof(glm::vec3)));
        glVertexArrayAttribBinding(array_.id(), attribute, 0);
    }
    check_gl("loading the rocks");
}

bool NearRocks::is_near(const Place& place, const glm::vec3& eye, float near_m) {
    const glm::vec4& at = place.ground_from_rock[3];
    return std::hypot(at.x - eye.x, at.z - eye.z) < near_m;
}

ViewBox NearRocks::bounds(const glm::vec3& eye, float near_m) const {
    constexpr float kFar = std::numeric_limits<float>::max();
    ViewBox box{glm::vec3(kFar), glm::vec3(-kFar)};
    for (const Place& place : places_) {
        if (!is_near(place, eye, near_m))
            continue;
        const glm::vec4& at = place.ground_from_rock[3];
        const float aside = place.reach.y;
        box.add({at.x - aside, 0.0F, at.z - aside});
        box.add({at.x + aside, place.reach.x, at.z + aside});
    }
    return box;
}

void NearRocks::draw(const ShaderProgram& program, const glm::vec3& eye, float near_m) {
    std::vector<Place> shown;
    std::vector<std::size_t> meshes;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        if (!is_near(places_[i], eye, near_m))
            continue;
        shown.push_back(places_[i]);
        meshes.push_back(mesh_of_[i]);
    }
    if (shown.empty())
        return;
    glNamedBufferSubData(shown_.id(), 0, static_cast<GLsizeiptr>(shown.size() * sizeof(Place)),
                         shown.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, shown_.id());
    glBindVertexArray(array_.id());
    program.use();
    for (std::size_t first = 0, next = 0; first < shown.size(); first = next) {
        while (next < shown.size() && meshes[next] == meshes[first])
            ++next;
        const Part& part = meshes_[meshes[first]];
        program.set("first_place", static_cast<int>(first));
        glDrawArraysInstanced(GL_TRIANGLES, part.first, part.count,
                              static_cast<GLsizei>(next - first));
    }
}

std::string near_rock_vertex_glsl() {
    return "#version 450 core\n" + std::string(ranges_glsl()) + std::string(heights_glsl()) +
           kVertex;
}

}  // namespace scree::terrain
