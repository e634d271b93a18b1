#pragma once

#include "meshing/gltf/gltf_scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

namespace scree::meshing {

/// What a file may cost before it is refused.
struct GltfLimits {
    std::size_t max_bytes = std::size_t{1} << 30;       ///< Of the file.
    std::size_t max_json_bytes = std::size_t{1} << 26;  ///< Of its JSON part.
    std::size_t max_vertices = 50'000'000;              ///< Of all meshes together.
    std::size_t max_triangles = 100'000'000;            ///< Of all meshes together.
    std::size_t max_placements = 5'000'000;             ///< Nodes and copies that show a mesh.
};

/// One place where a mesh is seen.
struct GltfPlacement {
    std::string node;                 ///< Name of the node; copies share it.
    std::size_t mesh = 0;             ///< Index into the meshes.
    glm::dmat4 world_from_mesh{1.0};  ///< Finite.
};

/// The geometry of a GLB file; materials and pictures are passed over.
struct LoadedGltf {
    std::vector<GltfMesh> meshes;           ///< The parts of one glTF mesh are joined.
    std::vector<GltfPlacement> placements;  ///< Of the default scene, copies included.
};

/// Read the triangles of a binary glTF 2.0 file, quantised or not, with EXT_mesh_gpu_instancing.
///
/// Nothing outside the bytes is ever opened. Positions are as stored: a quantised mesh needs its
/// placement's matrix to become metres.
/// @throw InvalidInput  the file is no binary glTF, is damaged, asks for an extension that is not
///        known here, refers to another file, holds anything but triangle lists, or passes a limit.
LoadedGltf decode_glb(std::span<const std::uint8_t> bytes, const GltfLimits& limits = {});

/// The same from a file.
/// @throw IoError  it cannot be read or is larger than the limit.
LoadedGltf read_glb(const std::filesystem::path& path, const GltfLimits& limits = {});

}  // namespace scree::meshing
