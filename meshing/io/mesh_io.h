#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree::meshing {

enum class MeshFormat { Obj, Ply, Off, Stl, Glb };

/// By the ending of the name, in any case.
/// @throw IoError  the ending is none of .obj .ply .off .stl .glb.
MeshFormat mesh_format_of(const std::filesystem::path& path);

/// What a file may cost before it is refused.
struct MeshLimits {
    std::size_t max_bytes = std::size_t{4} << 30;  ///< Of the file.
    std::size_t max_vertices = 50'000'000;
    std::size_t max_triangles = 100'000'000;
};

/// A mesh as a file holds it, in the file's order. Not cleaned: see clean_mesh().
struct MeshFile {
    TriMesh mesh;                      ///< Without normals; no triangles in a cloud of points.
    std::vector<glm::u8vec3> colours;  ///< One a vertex, or none.
};

/// Read the bytes of a mesh file.
///
/// Polygons are cut into fans. STL knows no vertices: equal places become one, in the order in
/// which they first occur. The parts of a GLB are joined where its nodes place them. OBJ texture
/// coordinates are kept where every vertex has one; normals are passed over. Nothing is
/// allocated on the word of a count that the bytes cannot hold, and no other file is opened.
/// @param name  For messages.
/// @throw InvalidInput  the bytes are damaged, hold no vertex, name one that is not there, hold a
///                      number that is none, or pass a limit.
MeshFile decode_mesh(std::span<const std::uint8_t> bytes, MeshFormat format, std::string_view name,
                     const MeshLimits& limits = {});

/// The same from a file; its ending tells the format.
/// @throw IoError  it cannot be read or is larger than the limit.
MeshFile read_mesh(const std::filesystem::path& path, const MeshLimits& limits = {});

struct MeshWriteOptions {
    bool text = false;  ///< PLY and STL as text; OBJ and OFF always are.
};

/// A mesh as the bytes of a file, indices in their order. Numbers in text read back the same.
/// Colours are written to PLY, OFF and GLB and left out of the others.
/// @throw InvalidInput  check_mesh() fails, there are not as many colours as vertices or none, or
///                      the format cannot hold so much.
std::string encode_mesh(const MeshFile& file, MeshFormat format,
                        const MeshWriteOptions& options = {});

/// The same into a file, whole or not at all; its ending tells the format.
void write_mesh(const std::filesystem::path& path, const MeshFile& file,
                const MeshWriteOptions& options = {});

}  // namespace scree::meshing
