#include "terrain/view/view_meshes.h"

#include "base/error.h"
#include "terrain/view/crease_normals.h"

#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <vector>

#include <glm/vec4.hpp>

namespace scree::terrain {
namespace {

void add_attribute(const GlVertexArray& array, GLuint place, GLint n_floats, GLuint offset) {
    glEnableVertexArrayAttrib(array.id(), place);
    glVertexArrayAttribFormat(array.id(), place, n_floats, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(array.id(), place, 0);
}

template <class T>
GlBuffer filled(const std::vector<T>& values) {
    GlBuffer buffer(0U);
    glNamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(values.size() * sizeof(T)),
                         values.data(), 0);
    return buffer;
}

std::uint64_t hash_bytes(std::uint64_t hash, const void* data, std::size_t n_bytes) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i + 8 <= n_bytes; i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + i, 8);
        hash = (hash ^ word) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 29U;
    }
    for (std::size_t i = n_bytes / 8 * 8; i < n_bytes; ++i)
        hash = (hash ^ bytes[i]) * 0x100000001B3ULL;
    return (hash ^ n_bytes) * 0x9E3779B97F4A7C15ULL;
}

std::uint64_t hash_of(const meshing::TriMesh& mesh) {
    std::uint64_t hash = 1469598103934665603ULL;
    hash = hash_bytes(hash, mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
    hash = hash_bytes(hash, mesh.normals.data(), mesh.normals.size() * sizeof(glm::vec3));
    return hash_bytes(hash, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
}

}  // namespace

DrawnMesh upload_lattice(const Lattice& lattice) {
    DrawnMesh mesh;
    mesh.array = GlVertexArray(0U);
    mesh.corners = filled(lattice.positions);
    mesh.indices = filled(lattice.patches);
    mesh.n_drawn = static_cast<int>(lattice.patches.size() * 6U);
    glVertexArrayVertexBuffer(mesh.array.id(), 0, mesh.corners.id(), 0, sizeof(glm::vec2));
    glVertexArrayElementBuffer(mesh.array.id(), mesh.indices.id());
    add_attribute(mesh.array, 0, 2, 0);
    return mesh;
}

DrawnMesh upload_walls(const GroundArea& area, double step) {
    const auto x0 = static_cast<float>(area.x);
    const auto z0 = static_cast<float>(area.z);
    const auto x1 = static_cast<float>(area.x + area.width);
    const auto z1 = static_cast<float>(area.z + area.depth);
    const glm::vec2 ring[5] = {{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}, {x0, z0}};
    std::vector<glm::vec4> corners;
    for (int side = 0; side < 4; ++side) {
        const glm::vec2 a = ring[side];
        const glm::vec2 b = ring[side + 1];
        const double length = side % 2 == 0 ? area.width : area.depth;
        const int n = std::max(1, static_cast<int>(std::ceil(length / step)));
        for (int i = 0; i < n; ++i) {
            const glm::vec2 p = a + (b - a) * (static_cast<float>(i) / static_cast<float>(n));
            const glm::vec2 q = a + (b - a) * (static_cast<float>(i + 1) / static_cast<float>(n));
            const auto s = static_cast<float>(side);
            const glm::vec4 quad[4] = {{p, 1, s}, {q, 1, s}, {q, 0, s}, {p, 0, s}};
            for (const int corner : {0, 1, 2, 0, 2, 3})
                corners.push_back(quad[corner]);
        }
    }
    DrawnMesh mesh;
    mesh.array = GlVertexArray(0U);
    mesh.corners = filled(corners);
    mesh.n_drawn = static_cast<int>(corners.size());
    glVertexArrayVertexBuffer(mesh.array.id(), 0, mesh.corners.id(), 0, sizeof(glm::vec4));
    add_attribute(mesh.array, 0, 4, 0);
    return mesh;
}

const DrawnMesh& ObjectMeshes::get(const TerrainObject& object) {
    if (object.mesh == nullptr)
        fail<InvalidInput>("an object of the frame has no mesh");
    Kept& kept = kept_[hash_of(*object.mesh)];
    kept.used = true;
    if (kept.mesh.array)
        return kept.mesh;
    const auto corners = shaded_corners(*object.mesh);
    DrawnMesh& mesh = kept.mesh;
    mesh.array = GlVertexArray(0U);
    mesh.corners = filled(corners);
    mesh.n_drawn = static_cast<int>(corners.size());
    glVertexArrayVertexBuffer(mesh.array.id(), 0, mesh.corners.id(), 0, sizeof(ShadedCorner));
    add_attribute(mesh.array, 0, 3, 0);
    add_attribute(mesh.array, 1, 3, sizeof(glm::vec3));
    return mesh;
}

void ObjectMeshes::end_frame() {
    std::erase_if(kept_, [](const auto& entry) { return !entry.second.used; });
    for (auto& [hash, kept] : kept_)
        kept.used = false;
}

}  // namespace scree::terrain
