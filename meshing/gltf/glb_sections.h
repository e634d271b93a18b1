#pragma once

// Inside the writer alone; not installed.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <tiny_gltf.h>

namespace scree::meshing::gltf {

// What the file says of an array of values; tinygltf's own takes ten times the memory.
struct Accessor {
    int type = TINYGLTF_TYPE_SCALAR;
    int component = TINYGLTF_COMPONENT_TYPE_FLOAT;
    std::size_t count = 0;
    bool normalised = false;
    bool bounded = false;  // low and high are said
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    int view = -1;
    std::size_t offset = 0;  // in the view
};

// One bufferView that fills up accessor by accessor, each on a four-byte boundary.
struct Section {
    std::vector<std::vector<std::uint8_t>> parts;
    std::size_t size = 0;        // of all parts and what pads them
    std::vector<int> accessors;  // those that lie in it
    std::size_t stride = 0;      // 0: tightly packed
    int target = 0;              // 0: neither vertices nor indices
};

struct Sections {
    Section texture, positions, normals, texcoords, wide_texcoords, colours;
    Section indices, wide_indices, instances;
};

/// Empty sections with the strides and targets that vertices and indices have.
Sections open_sections(bool quantise);

/// Move `bytes` into the section; the accessor gets its place there.
/// @return the accessor's index.
int add_accessor(std::vector<Accessor>& accessors, Section& section,
                 std::vector<std::uint8_t> bytes, const Accessor& accessor);

/// Make the section a bufferView of the model's buffer, which has `n_bytes` so far, unless it is
/// empty.
/// @return the bytes of the buffer with it.
/// @throw InvalidInput  the buffer would pass 2 GiB.
std::size_t close_section(tinygltf::Model& model, std::vector<Accessor>& accessors,
                          const Section& section, std::size_t n_bytes);

/// `n_bytes` up to a boundary of four bytes.
std::size_t padded(std::size_t n_bytes);

}  // namespace scree::meshing::gltf
