#pragma once

#include "meshing/gltf/gltf_scene.h"
#include "meshing/rocks/rock_lod.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/rock_patch.h"
#include "vision/rock_data.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scree::meshing {

/// Name of a rock in every file: "rock-0001" is the one with label 1 in the label map.
std::string rock_name(std::size_t index);

/// What rocks.glb holds: every rock a named node at its place, the photograph as the texture.
///
/// `extras` of a node: label, confidence, touches_border, depth_m, diameter_m (of the disc of equal
/// area), box_min_m, box_max_m, bounding_radius_m, inscribed_radius_m; of the scene: image, method,
/// metres_per_pixel, scale_known, size_m (of the photographed ground).
/// @param texture  A JPEG or PNG of the photograph, any size; empty for plain grey.
/// @throw InvalidInput  a mesh names a rock that the set does not have.
GltfScene rock_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                     std::vector<std::uint8_t> texture = {});

/// The same, taking the meshes out of the rocks: a large scene lies in memory once. `rocks` is
/// empty afterwards.
GltfScene rock_scene(const vision::RockSet& set, std::vector<RockMesh>&& rocks,
                     std::vector<std::uint8_t> texture = {});

/// The same with each rock at `level` of its chain, or at its last if it is shorter. Level 0 is the
/// rock's own mesh, whatever the chain holds there.
/// @throw InvalidInput  there is not one chain with a level for each rock.
GltfScene rock_lod_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                         const std::vector<std::vector<LodLevel>>& chains, std::size_t level,
                         std::vector<std::uint8_t> texture = {});

/// The same with all levels in one scene: each rock's node names its coarser selves, which a
/// reader of MSFT_lod swaps in and others do not see.
/// @throw InvalidInput  there is not one chain with a level for each rock.
GltfScene rock_lods_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                          const std::vector<std::vector<LodLevel>>& chains,
                          std::vector<std::uint8_t> texture = {});

/// Most levels that any of the chains has.
std::size_t deepest_level(const std::vector<std::vector<LodLevel>>& chains);

/// What lods.json holds: for each file its level, greatest error in metres, vertices and
/// triangles; for each rock the error in metres and the triangles of its own levels.
/// @param files  One name a level, relative to lods.json, the full meshes first.
/// @throw InvalidInput  the number of files is not deepest_level().
std::string lods_json(const std::vector<RockMesh>& rocks,
                      const std::vector<std::vector<LodLevel>>& chains,
                      const std::vector<std::string>& files);

/// What patch.glb holds: a node for every rock that the patch uses, with its copies.
///
/// `extras` of a node: label; of the scene: size_m, coverage and what rock_scene() says of the
/// photograph.
/// @throw InvalidInput  a prototype or instance of the patch names nothing that exists.
GltfScene patch_scene(const vision::RockSet& set, const std::vector<RockMesh>& rocks,
                      const RockPatch& patch, std::vector<std::uint8_t> texture = {});

}  // namespace scree::meshing
