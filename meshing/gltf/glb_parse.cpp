#include "meshing/gltf/glb_parse.h"

#include "base/error.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <utility>

namespace scree::meshing::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr int kDeepest = 64;                      // the parser below recurses

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

// The JSON part of the container, after its header has been found sound.
std::span<const std::uint8_t> json_of(std::span<const std::uint8_t> bytes,
                                      const GltfLimits& limits) {
    if (bytes.size() < 20 || word(bytes, 0) != kMagic)
        fail<InvalidInput>("it is no binary glTF file (.glb)");
    if (bytes.size() > limits.max_bytes)
        fail<InvalidInput>("it has ", bytes.size(), " bytes, the limit is ", limits.max_bytes);
    if (word(bytes, 4) != 2)
        fail<InvalidInput>("it is glTF version ", word(bytes, 4), ", only 2 is read");
    if (word(bytes, 8) != bytes.size())
        fail<InvalidInput>("its header says ", word(bytes, 8), " bytes, it has ", bytes.size());
    const std::size_t length = word(bytes, 12);
    if (word(bytes, 16) != kJsonChunk || length > bytes.size() - 20)
        fail<InvalidInput>("its first chunk is no JSON of the length it states");
    if (length > limits.max_json_bytes)
        fail<InvalidInput>("its JSON has ", length, " bytes, the limit is ", limits.max_json_bytes);
    return bytes.subspan(20, length);
}

void check_depth(std::span<const std::uint8_t> json) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const auto c = static_cast<char>(json[i]);
        if (quoted && c == '\\') {
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted && (c == '{' || c == '[')) {
            if (++depth > kDeepest)
                fail<InvalidInput>("its JSON is nested deeper than ", kDeepest, " levels");
        } else if (!quoted && (c == '}' || c == ']')) {
            --depth;
        }
    }
}

bool leave_picture(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                   const unsigned char*, int, void*) {
    return true;
}

tinygltf::FsCallbacks no_files() {
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return false; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&,
                                 void*) { return false; };
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
    return callbacks;
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text.empty() ? "its JSON describes no glTF asset" : text;
}

std::string view_fault(const tinygltf::Model& model, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size())
        return "has no bufferView that exists";
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
        return "lies in a bufferView without a buffer";
    const std::size_t n_bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    if (view.byteOffset > n_bytes || view.byteLength > n_bytes - view.byteOffset)
        return "lies in a bufferView that ends outside its buffer";
    return {};
}

int index_of(const tinygltf::Value& attributes, const char* name) {
    if (!attributes.Has(name))
        return -1;
    const tinygltf::Value& value = attributes.Get(name);
    return value.IsInt() && value.GetNumberAsInt() >= 0 ? value.GetNumberAsInt() : -2;
}

}  // namespace

tinygltf::Model parse_glb(std::span<const std::uint8_t> bytes, const GltfLimits& limits) {
    check_depth(json_of(bytes, limits));
    tinygltf::Model model;
    std::string error;
    std::string warning;
    bool read = false;
    try {
        tinygltf::TinyGLTF reader;
        reader.SetImageLoader(leave_picture, nullptr);
        reader.SetFsCallbacks(no_files());
        read = reader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                           static_cast<unsigned>(bytes.size()), "");
    } catch (const std::exception& thrown) {  // the JSON library throws on wrong types
        error += thrown.what();
    }
    if (!read)
        fail<InvalidInput>(one_line(error));
    return model;
}

std::string accessor_fault(const tinygltf::Model& model, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
        return "does not exist";
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (accessor.sparse.isSparse)
        return "is sparse, which is not read";
    const int components = tinygltf::GetNumComponentsInType(static_cast<unsigned>(accessor.type));
    const int size =
        tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(accessor.componentType));
    if (components < 1 || size < 1 || size > 4)
        return "has a type that glTF does not know";
    if (std::string fault = view_fault(model, accessor.bufferView); !fault.empty())
        return fault;
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const auto element = static_cast<std::size_t>(components) * static_cast<std::size_t>(size);
    const std::size_t stride = view.byteStride == 0 ? element : view.byteStride;
    if (accessor.count == 0 || stride < element)
        return "is empty or overlaps itself";
    if (accessor.byteOffset > view.byteLength || element > view.byteLength - accessor.byteOffset ||
        (view.byteLength - accessor.byteOffset - element) / stride < accessor.count - 1)
        return "ends outside its bufferView";
    if ((view.byteOffset + accessor.byteOffset) % static_cast<std::size_t>(size) != 0 ||
        stride % static_cast<std::size_t>(size) != 0)
        return "is not aligned to the size of its components";
    return {};
}

ElementReader::ElementReader(const tinygltf::Model& model, int index) {
    const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const auto& buffer = model.buffers[static_cast<std::size_t>(view.buffer)];
    data_ = buffer.data.data() + view.byteOffset + accessor.byteOffset;
    count_ = accessor.count;
    components_ = tinygltf::GetNumComponentsInType(static_cast<unsigned>(accessor.type));
    component_type_ = accessor.componentType;
    component_size_ = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(component_type_)));
    stride_ = view.byteStride == 0 ? component_size_ * static_cast<std::size_t>(components_)
                                   : view.byteStride;
    normalised_ = accessor.normalized;
}

namespace {

template <class T>
double loaded(const unsigned char* at) {
    T value{};
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

}  // namespace

double ElementReader::stored(std::size_t element, int component) const {
    const unsigned char* const at =
        data_ + element * stride_ + static_cast<std::size_t>(component) * component_size_;
    switch (component_type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return loaded<std::int8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return loaded<std::uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return loaded<std::int16_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return loaded<std::uint16_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return loaded<std::uint32_t>(at);
        case TINYGLTF_COMPONENT_TYPE_INT:
            return loaded<std::int32_t>(at);
        default:
            return loaded<float>(at);
    }
}

double ElementReader::at(std::size_t element, int component) const {
    const double value = stored(element, component);
    if (!normalised_)
        return value;
    switch (component_type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::max(value / 127.0, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return value / 255.0;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::max(value / 32767.0, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return value / 65535.0;
        default:
            return value;
    }
}

InstanceAccessors instance_accessors(const tinygltf::Node& node) {
    InstanceAccessors found;
    const tinygltf::Value& extension = node.extensions.at(kInstancing);
    if (!extension.IsObject() || !extension.Has("attributes") ||
        !extension.Get("attributes").IsObject()) {
        found.fault = "has no attributes";
        return found;
    }
    const tinygltf::Value& attributes = extension.Get("attributes");
    found.translation = index_of(attributes, "TRANSLATION");
    found.rotation = index_of(attributes, "ROTATION");
    found.scale = index_of(attributes, "SCALE");
    for (const std::string& name : attributes.Keys())
        if (name != "TRANSLATION" && name != "ROTATION" && name != "SCALE")
            found.others.push_back(name);
    if (attributes.Keys().empty())
        found.fault = "has no attributes";
    if (found.translation == -2 || found.rotation == -2 || found.scale == -2)
        found.fault = "names an accessor that is no index";
    return found;
}

NodeOrder node_order(const tinygltf::Model& model) {
    NodeOrder order;
    std::vector<std::pair<int, int>> open;  // node, parent; the next one lies at the end
    std::vector<bool> seen(model.nodes.size());
    if (!model.scenes.empty()) {
        const auto last = static_cast<int>(model.scenes.size()) - 1;
        const auto scene = static_cast<std::size_t>(std::clamp(model.defaultScene, 0, last));
        for (const int node : model.scenes[scene].nodes)
            open.emplace_back(node, -1);
    }
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
        const auto [index, parent] = open.back();
        open.pop_back();
        const auto node = static_cast<std::size_t>(index);
        if (index < 0 || node >= model.nodes.size()) {
            order.fault = "node " + std::to_string(index) + " does not exist";
        } else if (seen[node]) {
            order.fault = "node " + std::to_string(index) + " is reached twice";
        } else {
            seen[node] = true;
            order.nodes.push_back(node);
            order.parents.push_back(parent);
            const auto& children = model.nodes[node].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                open.emplace_back(*child, index);
        }
    }
    return order;
}

}  // namespace scree::meshing::gltf
