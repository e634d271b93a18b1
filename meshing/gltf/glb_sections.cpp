#include "meshing/gltf/glb_sections.h"

#include "base/error.h"

#include <utility>

namespace scree::meshing::gltf {
namespace {

constexpr std::size_t kMostBytes = 0x7fff0000;  // offsets are written as 32-bit signed numbers

}  // namespace

std::size_t padded(std::size_t n_bytes) {
    return (n_bytes + 3) / 4 * 4;
}

int add_accessor(std::vector<Accessor>& accessors, Section& section,
                 std::vector<std::uint8_t> bytes, const Accessor& accessor) {
    section.accessors.push_back(static_cast<int>(accessors.size()));
    accessors.push_back(accessor);
    accessors.back().offset = section.size;
    section.size += padded(bytes.size());
    section.parts.push_back(std::move(bytes));
    return section.accessors.back();
}

std::size_t close_section(tinygltf::Model& model, std::vector<Accessor>& accessors,
                          const Section& section, std::size_t n_bytes) {
    if (section.size == 0)
        return n_bytes;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = n_bytes;
    view.byteLength = section.size;
    view.byteStride = section.stride;
    view.target = section.target;
    if (n_bytes + section.size > kMostBytes)
        fail<InvalidInput>("the meshes need more than 2 GiB, use fewer segments or rocks");
    for (const int accessor : section.accessors)
        accessors[static_cast<std::size_t>(accessor)].view =
            static_cast<int>(model.bufferViews.size());
    model.bufferViews.push_back(view);
    return n_bytes + section.size;
}

Sections open_sections(bool quantise) {
    Sections s;
    s.positions.stride = quantise ? 8 : 12;
    s.normals.stride = quantise ? 4 : 12;
    s.texcoords.stride = 4;
    s.wide_texcoords.stride = 8;
    s.colours.stride = 4;
    for (Section* section : {&s.positions, &s.normals, &s.texcoords, &s.wide_texcoords, &s.colours})
        section->target = TINYGLTF_TARGET_ARRAY_BUFFER;
    s.indices.target = s.wide_indices.target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    return s;
}

}  // namespace scree::meshing::gltf
