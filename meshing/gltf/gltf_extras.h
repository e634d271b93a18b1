#pragma once

// Inside the writer alone; not installed.

#include "meshing/gltf/gltf_scene.h"

#include <vector>

#include <tiny_gltf.h>

namespace scree::meshing::gltf {

/// What applications say of a node or scene; null if nothing.
tinygltf::Value extras_value(const std::vector<GltfExtra>& extras);

}  // namespace scree::meshing::gltf
