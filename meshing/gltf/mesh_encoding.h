#pragma once

// Inside the writer alone; not installed.

#include "meshing/mesh/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace scree::meshing::gltf {

/// A mesh as bytes that lie in a GLB's buffer.
struct EncodedMesh {
    std::size_t n_vertices = 0;
    std::size_t n_indices = 0;
    std::vector<std::uint8_t> positions;  ///< float[3], or int16[3] padded to 8 bytes.
    std::vector<std::uint8_t> normals;    ///< float[3], or int8[3] padded to 4 bytes; may be empty.
    std::vector<std::uint8_t> texcoords;  ///< float[2] or uint16[2]; may be empty.
    std::vector<std::uint8_t> colours;    ///< uint8[4], linear; may be empty.
    std::vector<std::uint8_t> indices;    ///< uint16 or uint32.
    bool wide_indices = false;            ///< uint32.
    bool coded_texcoords = false;         ///< uint16.
    glm::dvec3 low{0.0};                  ///< Least stored position, component by component.
    glm::dvec3 high{0.0};                 ///< Greatest.
    double scale = 1.0;                   ///< Metres that a stored position of 1 stands for.
};

struct EncodingOptions {
    bool quantise = false;
    bool reorder = true;
    bool texcoords = true;
};

/// Bytes of colours as a screen shows them, as the linear light that glTF wants.
std::vector<std::uint8_t> encode_colours(const std::vector<glm::u8vec3>& colours);

/// @pre check_mesh() passes and there is a triangle.
EncodedMesh encode_mesh(TriMesh mesh, const EncodingOptions& options);

}  // namespace scree::meshing::gltf
