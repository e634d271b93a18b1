#include "meshing/io/mesh_io.h"

#include "base/whole_file.h"
#include "meshing/gltf/gltf_read.h"
#include "meshing/gltf/gltf_write.h"
#include "meshing/io/mesh_codecs.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace scree::meshing {
namespace io {

void Builder::expect(std::size_t n_vertices, std::size_t n_triangles) {
    if (n_vertices > source_.limits.max_vertices)
        source_.refuse("it declares ", n_vertices, " vertices, at most ",
                       source_.limits.max_vertices, " are read");
    if (n_triangles > source_.limits.max_triangles)
        source_.refuse("it declares ", n_triangles, " faces, at most ",
                       source_.limits.max_triangles, " triangles are read");
    file.mesh.positions.reserve(n_vertices);
    file.mesh.triangles.reserve(n_triangles);
}

void Builder::add_vertex(double x, double y, double z) {
    const glm::vec3 p(x, y, z);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        source_.refuse("vertex ", file.mesh.positions.size(), " is no place that floats can hold");
    if (file.mesh.positions.size() >= source_.limits.max_vertices)
        source_.refuse("it has more than ", source_.limits.max_vertices, " vertices");
    file.mesh.positions.push_back(p);
    if (exact != nullptr)
        exact->emplace_back(x, y, z);
}

void Builder::add_polygon(std::span<const std::uint32_t> polygon) {
    if (polygon.size() < 3)
        source_.refuse("a face has ", polygon.size(), " corners, at least 3 are needed");
    if (polygon.size() - 2 > source_.limits.max_triangles - file.mesh.triangles.size())
        source_.refuse("it has more than ", source_.limits.max_triangles, " triangles");
    for (std::size_t k = 2; k < polygon.size(); ++k)
        file.mesh.triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
}

MeshFile Builder::finish() {
    const std::size_t n = file.mesh.positions.size();
    if (n == 0)
        source_.refuse("it holds no vertex");
    for (const glm::uvec3& t : file.mesh.triangles)
        if (std::max({t.x, t.y, t.z}) >= n)
            source_.refuse("a face names vertex ", std::max({t.x, t.y, t.z}), " of ", n,
                           ", counted from 0");
    if (file.colours.size() != n)
        file.colours.clear();
    return std::move(file);
}

}  // namespace io

namespace {

// All placements as one mesh in the world.
MeshFile join_placements(const LoadedGltf& loaded, const io::Source& source) {
    MeshFile file;
    bool has_texcoords = true;
    for (const GltfPlacement& placement : loaded.placements) {
        const TriMesh& part = loaded.meshes[placement.mesh].geometry;
        const auto first = static_cast<std::uint32_t>(file.mesh.positions.size());
        if (part.positions.size() > source.limits.max_vertices - first ||
            part.triangles.size() > source.limits.max_triangles - file.mesh.triangles.size())
            source.refuse("its placed meshes pass ", source.limits.max_vertices, " vertices or ",
                          source.limits.max_triangles, " triangles");
        const bool mirrored = glm::determinant(glm::dmat3(placement.world_from_mesh)) < 0.0;
        for (const glm::vec3& p : part.positions)
            file.mesh.positions.emplace_back(placement.world_from_mesh *
                                             glm::dvec4(glm::dvec3(p), 1.0));
        for (const glm::uvec3& t : part.triangles)
            file.mesh.triangles.push_back(first + (mirrored ? glm::uvec3(t.x, t.z, t.y) : t));
        has_texcoords = has_texcoords && part.texcoords.size() == part.positions.size();
        file.mesh.texcoords.insert(file.mesh.texcoords.end(), part.texcoords.begin(),
                                   part.texcoords.end());
    }
    if (!has_texcoords)
        file.mesh.texcoords.clear();
    if (file.mesh.positions.empty())
        source.refuse("it shows no mesh");
    check_mesh(file.mesh);
    return file;
}

MeshFile decode_glb_mesh(std::span<const std::uint8_t> bytes, const io::Source& source) {
    try {
        const GltfLimits limits{.max_bytes = source.limits.max_bytes,
                                .max_vertices = source.limits.max_vertices,
                                .max_triangles = source.limits.max_triangles};
        return join_placements(decode_glb(bytes, limits), source);
    } catch (const InvalidInput& error) {
        const std::string_view text = error.what();
        if (text.starts_with("cannot read"))
            throw;
        source.refuse(text);
    }
}

std::string encode_glb_mesh(const MeshFile& file) {
    GltfScene scene;
    scene.name = "mesh";
    scene.meshes.push_back({"mesh", file.mesh, file.colours});
    GltfNode node;
    node.name = "mesh";
    node.mesh = 0;
    scene.nodes.push_back(node);
    const auto bytes = encode_glb(std::move(scene), {.reorder = false});
    return {bytes.begin(), bytes.end()};
}

}  // namespace

MeshFormat mesh_format_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::string_view kEndings[] = {".obj", ".ply", ".off", ".stl", ".glb"};
    for (std::size_t i = 0; i < std::size(kEndings); ++i)
        if (ending == kEndings[i])
            return static_cast<MeshFormat>(i);
    fail<IoError>("cannot tell the format of ", path.string(),
                  ": its name must end in .obj, .ply, .off, .stl or .glb");
}

MeshFile decode_mesh(std::span<const std::uint8_t> bytes, MeshFormat format, std::string_view name,
                     const MeshLimits& limits) {
    const io::Source source{
        {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, limits};
    if (bytes.size() > limits.max_bytes)
        source.refuse("it has ", bytes.size(), " bytes, at most ", limits.max_bytes, " are read");
    switch (format) {
        case MeshFormat::Obj:
            return io::decode_obj(source);
        case MeshFormat::Ply:
            return io::decode_ply(source);
        case MeshFormat::Off:
            return io::decode_off(source);
        case MeshFormat::Stl:
            return io::decode_stl(source);
        case MeshFormat::Glb:
            return decode_glb_mesh(bytes, source);
    }
    fail<InvalidInput>("the mesh format holds no named value");
}

MeshFile read_mesh(const std::filesystem::path& path, const MeshLimits& limits) {
    const MeshFormat format = mesh_format_of(path);
    const std::string bytes = read_whole_file(path, limits.max_bytes);
    return decode_mesh({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, format,
                       path.string(), limits);
}

std::string encode_mesh(const MeshFile& file, MeshFormat format, const MeshWriteOptions& options) {
    check_mesh(file.mesh);
    if (!file.colours.empty() && file.colours.size() != file.mesh.positions.size())
        fail<InvalidInput>("the mesh has ", file.mesh.positions.size(), " vertices but ",
                           file.colours.size(), " colours");
    switch (format) {
        case MeshFormat::Obj:
            return io::encode_obj(file);
        case MeshFormat::Ply:
            return io::encode_ply(file, options.text);
        case MeshFormat::Off:
            return io::encode_off(file);
        case MeshFormat::Stl:
            return io::encode_stl(file, options.text);
        case MeshFormat::Glb:
            return encode_glb_mesh(file);
    }
    fail<InvalidInput>("the mesh format holds no named value");
}

void write_mesh(const std::filesystem::path& path, const MeshFile& file,
                const MeshWriteOptions& options) {
    write_whole_file(path, std::string_view(encode_mesh(file, mesh_format_of(path), options)));
}

}  // namespace scree::meshing
