#include "meshing/gltf/glb_sections.h"

#include "base/error.h"

namespace scree::meshing::gltf {
namespace {

constexpr std::size_t kMostBytes = 0x7fff0000;  // offsets are written as 32-bit signed numbers

std::size_t padded(std::size_t n_bytes) {
    return (n_bytes + 3) / 4 * 4;
}

}  // namespace

int add_accessor(tinygltf::Model& model, Section& section, const std::vector<std::uint8_t>& bytes,
                 tinygltf::Accessor accessor) {
    accessor.byteOffset = section.bytes.size();
    section.bytes.insert(section.bytes.end(), bytes.begin(), bytes.end());
    section.bytes.resize(padded(section.bytes.size()));
    section.accessors.push_back(static_cast<int>(model.accessors.size()));
    model.accessors.push_back(std::move(accessor));
    return section.accessors.back();
}

tinygltf::Accessor accessor_of(int type, int component, std::size_t count, bool normalised) {
    tinygltf::Accessor accessor;
    accessor.type = type;
    accessor.componentType = component;
    accessor.count = count;
    accessor.normalized = normalised;
    return accessor;
}

void close_section(tinygltf::Model& model, Section& section) {
    if (section.bytes.empty())
        return;
    std::vector<unsigned char>& data = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = section.bytes.size();
    view.byteStride = section.stride;
    view.target = section.target;
    if (data.size() + section.bytes.size() > kMostBytes)
        fail<InvalidInput>("the meshes need more than 2 GiB, use fewer segments or rocks");
    data.insert(data.end(), section.bytes.begin(), section.bytes.end());
    data.resize(padded(data.size()));
    for (const int accessor : section.accessors)
        model.accessors[static_cast<std::size_t>(accessor)].bufferView =
            static_cast<int>(model.bufferViews.size());
    model.bufferViews.push_back(view);
    section.bytes = {};
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
