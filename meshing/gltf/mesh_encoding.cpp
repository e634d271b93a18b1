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
    std::vector<std::int16_t> coded(quantise ? 4 * mesh.positions.size() : 0);  // the fourth pads
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::dvec3 stored(mesh.positions[i]);
        if (quantise) {
            stored = glm::round(stored * (32767.0 / out.scale));
            for (int c = 0; c < 3; ++c)
                coded[4 * i + static_cast<std::size_t>(c)] = static_cast<std::int16_t>(stored[c]);
        }
        out.low = glm::min(out.low, stored);
        out.high = glm::max(out.high, stored);
    }
    out.positions = quantise ? bytes_of(coded) : bytes_of(mesh.positions);
}

void encode_normals(const TriMesh& mesh, bool quantise, EncodedMesh& out) {
    std::vector<glm::vec3> normals(mesh.normals.size());
    std::transform(mesh.normals.begin(), mesh.normals.end(), normals.begin(), unit);
    if (!quantise) {
        out.normals = bytes_of(normals);
        return;
    }
    std::vector<std::int8_t> coded(4 * normals.size());  // the fourth pads
    for (std::size_t i = 0; i < normals.size(); ++i)
        for (int c = 0; c < 3; ++c)
            coded[4 * i + static_cast<std::size_t>(c)] =
                static_cast<std::int8_t>(std::lround(127.0F * normals[i][c]));
    out.normals = bytes_of(coded);
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
    std::vector<std::uint16_t> coded;
    coded.reserve(2 * mesh.texcoords.size());
    for (const glm::vec2& t : mesh.texcoords)
        for (const float v : {t.x, t.y})
            coded.push_back(static_cast<std::uint16_t>(std::lround(65535.0F * v)));
    out.texcoords = bytes_of(coded);
}

void encode_indices(const TriMesh& mesh, EncodedMesh& out) {
    out.wide_indices = mesh.positions.size() > kMostShortVertices;
    if (out.wide_indices) {
        out.indices = bytes_of(mesh.triangles);
        return;
    }
    std::vector<std::uint16_t> coded;
    coded.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (const std::uint32_t v : {t.x, t.y, t.z})
            coded.push_back(static_cast<std::uint16_t>(v));
    out.indices = bytes_of(coded);
}

}  // namespace

std::vector<std::uint8_t> encode_colours(const std::vector<glm::u8vec3>& colours) {
    const auto linear = [](std::uint8_t coded) {
        const double c = coded / 255.0;
        const double light = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        return static_cast<std::uint8_t>(std::lround(255.0 * light));
    };
    std::vector<std::uint8_t> bytes;
    bytes.reserve(4 * colours.size());
    for (const glm::u8vec3& c : colours) {
        for (int k = 0; k < 3; ++k)
            bytes.push_back(linear(c[k]));
        bytes.push_back(255);
    }
    return bytes;
}

EncodedMesh encode_mesh(TriMesh mesh, const EncodingOptions& options) {
    if (options.reorder)
        optimise_for_gpu(mesh);
    EncodedMesh out;
    out.n_vertices = mesh.positions.size();
    out.n_indices = 3 * mesh.triangles.size();
    encode_positions(mesh, options.quantise, out);
    encode_normals(mesh, options.quantise, out);
    if (options.texcoords)
        encode_texcoords(mesh, options.quantise, out);
    encode_indices(mesh, out);
    return out;
}

}  // namespace scree::meshing::gltf
