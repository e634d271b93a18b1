#pragma once

// Inside the writer alone; not installed.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tiny_gltf.h>

namespace scree::meshing::gltf {

// One bufferView that fills up accessor by accessor, each on a four-byte boundary.
struct Section {
    std::vector<std::uint8_t> bytes;
    std::vector<int> accessors;  // those that lie in it
    std::size_t stride = 0;      // 0: tightly packed
    int target = 0;              // 0: neither vertices nor indices
};

struct Sections {
    Section positions, normals, texcoords, wide_texcoords, colours;
    Section indices, wide_indices, instances;
};

/// Empty sections with the strides and targets that vertices and indices have.
Sections open_sections(bool quantise);

/// An accessor that lies nowhere yet.
tinygltf::Accessor accessor_of(int type, int component, std::size_t count, bool normalised = false);

/// Append `bytes` to the section and the accessor to the model; returns the accessor's index.
int add_accessor(tinygltf::Model& model, Section& section, const std::vector<std::uint8_t>& bytes,
                 tinygltf::Accessor accessor);

/// Append the section to the model's buffer as a bufferView of its own, unless it is empty; its
/// bytes are given back.
/// @throw InvalidInput  the buffer would pass 2 GiB.
void close_section(tinygltf::Model& model, Section& section);

}  // namespace scree::meshing::gltf
