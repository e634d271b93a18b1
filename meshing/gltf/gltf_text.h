#pragma once

// Inside the writer alone; not installed.

#include "meshing/gltf/glb_sections.h"
#include "meshing/gltf/gltf_scene.h"

#include <string>
#include <vector>

namespace scree::meshing::gltf {

/// The parts of a mesh, as indices of accessors; -1 where there is none.
struct MeshText {
    int positions = -1;
    int normals = -1;
    int texcoords = -1;
    int colours = -1;
    int indices = -1;
};

/// What a node holds beside its name and place.
struct NodeText {
    int mesh = -1;
    double unit = 1.0;    ///< Metres that a stored position of 1 stands for.
    int first_child = 0;  ///< The children are nodes that follow each other.
    int n_children = 0;
    int translations = -1;  ///< Accessors of its copies; -1 without any.
    int rotations = -1;
    int scales = -1;
    const GltfNode* extras = nullptr;  ///< Node whose extras and coarser selves are named.
};

// The arrays that have an entry a rock, entry by entry, as JSON. There are tens of thousands of
// them, and tinygltf's documents of them would take a gigabyte and most of the writing time.
void append_accessor(std::string& json, const Accessor& accessor);
void append_mesh(std::string& json, const std::string& name, const MeshText& mesh);
void append_node(std::string& json, const std::string& name, const GltfTransform& place,
                 const NodeText& node);

}  // namespace scree::meshing::gltf
