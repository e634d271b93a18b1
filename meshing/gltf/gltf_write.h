#pragma once

#include "base/options.h"
#include "meshing/gltf/gltf_scene.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace scree::meshing {

struct GltfWriteOptions {
    bool quantise = false;   ///< 16-bit positions and texture coordinates, 8-bit normals.
    bool instancing = true;  ///< Copies as EXT_mesh_gpu_instancing; else a plain node each.
    bool reorder = true;     ///< Order triangles and vertices for the GPU's caches.
};

template <class Visitor>
void describe(GltfWriteOptions& o, Visitor&& field) {
    field("quantise", o.quantise, {.help = "half the size, by KHR_mesh_quantization"});
    field("instancing", o.instancing, {.help = "copies by EXT_mesh_gpu_instancing"});
    field("reorder", o.reorder, {.help = "order triangles for the GPU's caches"});
}

/// The scene as a binary glTF 2.0 file in memory.
///
/// A plain file (no copies, not quantised) uses core glTF alone. Vertices cost 32 bytes, quantised
/// ones 16 and are off by at most 1/65534 of the mesh's greatest coordinate; the factor that makes
/// them metres stands in the scale of the node or of its copies. Indices are 16 bits wide up to
/// 65,535 vertices. Vertices that no triangle uses are dropped if `reorder` is set. Extensions
/// that a reader must know are listed as required; coarser nodes are named by
/// MSFT_lod, which a reader may ignore. A scene that is moved here costs least memory: its meshes
/// go as they are written.
/// @throw InvalidInput  check_scene() fails, a mesh with colours shall be reordered, the texture is
/// no JPEG or PNG, or the file would pass
///        2 GiB.
std::vector<std::uint8_t> encode_glb(GltfScene scene, const GltfWriteOptions& options = {});

/// Takes the next bytes of a file.
using GlbSink = std::function<void(std::span<const std::uint8_t> bytes)>;

/// The same file handed over piece by piece, so that a large one never lies in memory whole.
/// Nothing is handed over where the scene is refused.
void encode_glb(GltfScene scene, const GltfWriteOptions& options, const GlbSink& sink);

}  // namespace scree::meshing
