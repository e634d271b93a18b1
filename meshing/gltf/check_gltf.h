#pragma once

#include "meshing/gltf/gltf_read.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scree::meshing {

/// Something wrong with a glTF file.
struct GltfFinding {
    enum class Severity { Warning, Error };
    Severity severity = Severity::Error;
    std::string where;  ///< Such as "node 3" or "accessor 17"; empty for the file as a whole.
    std::string what;   ///< The rest of the sentence.
};

/// Look for what other checkers pass over, above all EXT_mesh_gpu_instancing.
///
/// Instancing: the extension is declared; the node has a mesh; TRANSLATION, ROTATION and SCALE are
/// VEC3, VEC4 and VEC3 of the component types that the extension allows, equally long, with finite
/// numbers and quaternions of unit length; other attributes start with an underscore.
/// Structure: a sound container; nothing outside the file; accessors inside their buffers and
/// aligned; attributes of a primitive equally long; POSITION with true bounds; indices of vertices
/// that exist; normals of unit length; a tree of nodes; unit rotations; declared extensions.
/// @return No entry for a sound file; 100 at most. Never throws for bad bytes.
std::vector<GltfFinding> check_glb(std::span<const std::uint8_t> bytes,
                                   const GltfLimits& limits = {});

/// The same for a file.
/// @throw IoError  it cannot be read or is larger than the limit.
std::vector<GltfFinding> check_glb_file(const std::filesystem::path& path,
                                        const GltfLimits& limits = {});

}  // namespace scree::meshing
