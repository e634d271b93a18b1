#pragma once

#include "meshing/gltf/gltf_scene.h"
#include "meshing/rocks/rock_lod.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/rock_patch.h"
#include "vision/rock_data.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scree::apps {

/// Every rock as a named node at its place in the photograph.
/// @param texture  The photograph as a JPEG or PNG file; may be empty.
meshing::GltfScene scene_of_rocks(const vision::RockSet& set,
                                  const std::vector<meshing::RockMesh>& meshes,
                                  const std::vector<std::uint8_t>& texture);

using LodChains = std::vector<std::vector<meshing::LodLevel>>;

/// Levels that the longest chain has.
std::size_t level_count(const LodChains& chains);

/// The same scene with every rock at one level of detail, or its coarsest if it has fewer.
meshing::GltfScene scene_of_level(const vision::RockSet& set,
                                  const std::vector<meshing::RockMesh>& meshes,
                                  const LodChains& chains, std::size_t level,
                                  const std::vector<std::uint8_t>& texture);

/// One scene with all levels: coarser ones hang on the finest node of their rock.
meshing::GltfScene scene_of_all_levels(const vision::RockSet& set,
                                       const std::vector<meshing::RockMesh>& meshes,
                                       const LodChains& chains,
                                       const std::vector<std::uint8_t>& texture);

/// What lods/ holds, as JSON: a file, its triangles and its greatest error in metres a level.
std::string lods_json(const LodChains& chains, const std::vector<std::string>& files);

/// A patch as one node a prototype with the places of its copies.
meshing::GltfScene scene_of_patch(const meshing::RockPatch& patch,
                                  const std::vector<meshing::RockMesh>& meshes,
                                  const std::vector<std::uint8_t>& texture);

}  // namespace scree::apps
