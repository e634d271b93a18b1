#include "meshing/gltf/mesh_encoding.h"

#include "meshing/mesh/optimise.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
namespace scree::meshing::gltf {
namespace {

constexpr std::size_t kMostShortVertices = 65535;  // 65535 itself restarts primitives

template <class T>
void append(std::vector<std::uint8_t>& bytes, const T& value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(bytes.data() + at, &value, sizeof(T));
}

template <class T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& values) {
    std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
    if (!values.empty())
        std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

// Unit length within float rounding, which readers check; straight up if there is no direction.
glm::vec3 unit(const glm::vec3& normal) {
    const double length = glm::length(glm::dvec3(normal));
    return length > 1e-20 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0, 1, 0);
}

void encode_positions(const TriMesh& mesh, bool quantise, EncodedMesh& out) {
    out.low = glm::dvec3(std::numeric_limits<double>::max());
    out.high = -out.low;
    float reach = 0.0F;
    for (const glm::vec3& p : mesh.positions)
        reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (quantise && reach > 0.0F)
        out.scale = reach;
    for (const glm::vec3& p : mesh.positions) {
        glm::dvec3 stored(p);
        if (quantise) {
            stored = glm::round(stored * (32767.0 / out.scale));
            for (const double v : {stored.x, stored.y, stored.z, 0.0})  // the last one pads
                append(out.positions, static_cast<std::int16_t>(v));
        }
        out.low = glm::min(out.low, stored);
        out.high = glm::max(out.high, stored);
    }
    if (!quantise)
        out.positions = bytes_of(mesh.positions);
}

void encode_normals(const TriMesh& mesh, bool quantise, EncodedMesh& out) {
    for (const glm::vec3& normal : mesh.normals) {
        const glm::vec3 n = unit(normal);
        for (const float v : {n.x, n.y, n.z})
            if (quantise)
                append(out.normals, static_cast<std::int8_t>(std::lround(127.0F * v)));
            else
                append(out.normals, v);
        if (quantise)
            append(out.normals, std::int8_t{0});
    }
}

void encode_texcoords(const TriMesh& mesh, bool quantise, EncodedMesh& out) {
    const auto within = [](float v) { return v >= 0.0F && v <= 1.0F; };
    out.coded_texcoords =
        quantise && std::all_of(mesh.texcoords.begin(), mesh.texcoords.end(),
                                [&](const glm::vec2& t) { return within(t.x) && within(t.y); });
    if (!out.coded_texcoords) {
        out.texcoords = bytes_of(mesh.texcoords);
        return;
    }
    for (const glm::vec2& t : mesh.texcoords)
        for (const float v : {t.x, t.y})
            append(out.texcoords, static_cast<std::uint16_t>(std::lround(65535.0F * v)));
}

void encode_indices(const TriMesh& mesh, EncodedMesh& out) {
    out.wide_indices = mesh.positions.size() > kMostShortVertices;
    for (const glm::uvec3& t : mesh.triangles)
        for (const std::uint32_t v : {t.x, t.y, t.z})
            if (out.wide_indices)
                append(out.indices, v);
            else
                append(out.indices, static_cast<std::uint16_t>(v));
}

}  // namespace

EncodedMesh encode_mesh(const TriMesh& mesh, const EncodingOptions& options) {
    TriMesh ordered = mesh;
    if (options.reorder)
        optimise_for_gpu(ordered);
    EncodedMesh out;
    out.n_vertices = ordered.positions.size();
    out.n_indices = 3 * ordered.triangles.size();
    encode_positions(ordered, options.quantise, out);
    encode_normals(ordered, options.quantise, out);
    if (options.texcoords)
        encode_texcoords(ordered, options.quantise, out);
    encode_indices(ordered, out);
    return out;
}

}  // namespace scree::meshing::gltf
