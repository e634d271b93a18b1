#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/ext/quaternion_float.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// Where a copy of a mesh stands: first scaled, then turned, then moved.
struct GltfTransform {
    glm::vec3 translation{0.0F};                 ///< Metres.
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< Of unit length; w comes first here.
    glm::vec3 scale{1.0F};
};

/// One entry of an object's `extras`: data for programs that know what it means.
struct GltfExtra {
    std::string name;
    std::variant<double, bool, std::string, std::vector<double>> value;
};

/// A mesh that nodes refer to by its index.
struct GltfMesh {
    std::string name;
    TriMesh geometry;  ///< Texture coordinates are written if the scene has a texture.
    std::vector<glm::u8vec3> colours = {};  ///< One a vertex or none, as a screen shows them.
};

/// A named object of the scene.
struct GltfNode {
    std::string name;
    int mesh = -1;                         ///< Index into the scene's meshes; -1 is an empty node.
    GltfTransform transform;               ///< In the world; nodes have no parents here.
    std::vector<GltfTransform> instances;  ///< Copies inside the node; none means the mesh itself.
    std::vector<int> coarser;              ///< Nodes drawn in its stead from afar, finest first.
    std::vector<GltfExtra> extras;
};

/// What one GLB file holds: +Y up, right-handed, metres. Knows nothing of rocks.
struct GltfScene {
    std::string name;
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<std::uint8_t>
        texture;  ///< A JPEG or PNG file for all meshes; empty for plain grey.
    std::vector<GltfExtra> extras;
};

/// Throw InvalidInput, naming the mesh or node, unless meshes pass check_mesh() and have triangles,
/// every index exists, every number is finite and rotations have unit length to 1e-3.
void check_scene(const GltfScene& scene);

}  // namespace scree::meshing
