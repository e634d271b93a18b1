#pragma once

// Inside the reader and the checker alone; not installed.

#include "meshing/gltf/gltf_read.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace scree::meshing::gltf {

inline constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
inline constexpr const char* kQuantisation = "KHR_mesh_quantization";
inline constexpr const char* kLod = "MSFT_lod";

/// Parse without opening any file and without decoding pictures.
/// @throw InvalidInput  says what is wrong with the container or its JSON.
tinygltf::Model parse_glb(std::span<const std::uint8_t> bytes, const GltfLimits& limits);

/// What is wrong with an accessor, as the end of a sentence; empty if its elements may be read.
std::string accessor_fault(const tinygltf::Model& model, int index);

/// Elements of an accessor without fault.
class ElementReader {
public:
    ElementReader(const tinygltf::Model& model, int index);

    std::size_t count() const { return count_; }
    int components() const { return components_; }
    /// One component as a number; normalised integers come as -1..1 or 0..1.
    double at(std::size_t element, int component) const;
    /// The same without regard to `normalized`.
    double stored(std::size_t element, int component) const;

private:
    const unsigned char* data_ = nullptr;
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    std::size_t component_size_ = 0;
    int components_ = 0;
    int component_type_ = 0;
    bool normalised_ = false;
};

/// A copy's accessors in the instancing extension; -1 where absent.
struct InstanceAccessors {
    int translation = -1;
    int rotation = -1;
    int scale = -1;
    std::vector<std::string> others;  ///< Names of further attributes.
    std::string fault;                ///< What keeps the extension from being read; mostly empty.
};

/// @pre The node carries the extension.
InstanceAccessors instance_accessors(const tinygltf::Node& node);

/// Indices of the nodes below the default scene, parents first. A node that is reached twice is
/// listed once and named in `fault`, as are indices that do not exist.
struct NodeOrder {
    std::vector<std::size_t> nodes;
    std::vector<int> parents;  ///< Index of the parent node of each entry, or -1.
    std::string fault;
};
NodeOrder node_order(const tinygltf::Model& model);

}  // namespace scree::meshing::gltf
