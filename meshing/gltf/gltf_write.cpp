#include "meshing/gltf/gltf_write.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/gltf/glb_parse.h"
#include "meshing/gltf/glb_sections.h"
#include "meshing/gltf/gltf_extras.h"
#include "meshing/gltf/gltf_text.h"
#include "meshing/gltf/mesh_encoding.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <sstream>
#include <utility>

#include <glm/geometric.hpp>
#include <tiny_gltf.h>

namespace scree::meshing {
namespace {

using gltf::Accessor;
using gltf::EncodedMesh;
using gltf::kInstancing;
using gltf::kLod;
using gltf::kQuantisation;
using gltf::MeshText;
using gltf::NodeText;
using gltf::padded;
using gltf::Section;
using gltf::Sections;
using tinygltf::Model;

bool starts_with(const std::vector<std::uint8_t>& bytes, std::initializer_list<int> head) {
    return bytes.size() > head.size() && std::equal(head.begin(), head.end(), bytes.begin());
}

const char* mime_type(const std::vector<std::uint8_t>& bytes) {
    if (starts_with(bytes, {0xff, 0xd8, 0xff}))
        return "image/jpeg";
    if (starts_with(bytes, {0x89, 'P', 'N', 'G'}))
        return "image/png";
    fail<InvalidInput>("the texture of ", bytes.size(), " bytes is neither a JPEG nor a PNG file");
}

// A file on its way: what is said of its parts, as tinygltf's model and as text, and their bytes.
struct Draft {
    const GltfScene& scene;
    const GltfWriteOptions& options;
    Model model = {};
    Sections sections = {};
    std::vector<Accessor> accessors = {};
    std::vector<double> units = {};  // of every mesh: metres that a stored position of 1 stands for
    std::string meshes = {};
    std::string nodes = {};
    std::size_t n_bytes = 0;

    void close(const Section& section) {
        n_bytes = gltf::close_section(model, accessors, section, n_bytes);
    }
    double unit_of(const GltfNode& node) const {
        return node.mesh < 0 ? 1.0 : units[static_cast<std::size_t>(node.mesh)];
    }
};

void begin_entry(std::string& array) {
    if (!array.empty())
        array += ',';
}

// ---- meshes ----

Accessor accessor_of(int type, int component, std::size_t count, bool normalised = false) {
    return {.type = type, .component = component, .count = count, .normalised = normalised};
}

MeshText add_mesh(Draft& draft, EncodedMesh mesh) {
    Sections& sections = draft.sections;
    const bool quantise = draft.options.quantise;
    const auto add = [&](Section& section, std::vector<std::uint8_t>& bytes, Accessor accessor) {
        return gltf::add_accessor(draft.accessors, section, std::move(bytes), accessor);
    };
    MeshText text;
    auto positions =
        accessor_of(TINYGLTF_TYPE_VEC3,
                    quantise ? TINYGLTF_COMPONENT_TYPE_SHORT : TINYGLTF_COMPONENT_TYPE_FLOAT,
                    mesh.n_vertices, quantise);
    positions.bounded = true;
    positions.low = mesh.low;
    positions.high = mesh.high;
    text.positions = add(sections.positions, mesh.positions, positions);
    if (!mesh.normals.empty())
        text.normals =
            add(sections.normals, mesh.normals,
                accessor_of(TINYGLTF_TYPE_VEC3,
                            quantise ? TINYGLTF_COMPONENT_TYPE_BYTE : TINYGLTF_COMPONENT_TYPE_FLOAT,
                            mesh.n_vertices, quantise));
    if (!mesh.texcoords.empty())
        text.texcoords =
            add(mesh.coded_texcoords ? sections.texcoords : sections.wide_texcoords, mesh.texcoords,
                accessor_of(TINYGLTF_TYPE_VEC2,
                            mesh.coded_texcoords ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                                 : TINYGLTF_COMPONENT_TYPE_FLOAT,
                            mesh.n_vertices, mesh.coded_texcoords));
    if (!mesh.colours.empty())
        text.colours = add(sections.colours, mesh.colours,
                           accessor_of(TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                       mesh.n_vertices, true));
    text.indices = add(mesh.wide_indices ? sections.wide_indices : sections.indices, mesh.indices,
                       accessor_of(TINYGLTF_TYPE_SCALAR,
                                   mesh.wide_indices ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT
                                                     : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                   mesh.n_indices));
    return text;
}

// Takes the meshes out of the scene one by one, so that they never lie in memory twice.
std::vector<EncodedMesh> encode_meshes(GltfScene& scene, const GltfWriteOptions& options) {
    std::vector<EncodedMesh> encoded(scene.meshes.size());
    parallel_for_each_index(0, encoded.size(), 1, [&](std::size_t i) {
        encoded[i] = gltf::encode_mesh(std::move(scene.meshes[i].geometry),
                                       {options.quantise, options.reorder, !scene.texture.empty()});
        encoded[i].colours = gltf::encode_colours(scene.meshes[i].colours);
    });
    return encoded;
}

void add_meshes(Draft& draft, std::vector<EncodedMesh> encoded) {
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        draft.units.push_back(encoded[i].scale);
        begin_entry(draft.meshes);
        gltf::append_mesh(draft.meshes, draft.scene.meshes[i].name,
                          add_mesh(draft, std::move(encoded[i])));
    }
}

// ---- material ----

bool has_colours(const GltfScene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const GltfMesh& mesh) { return !mesh.colours.empty(); });
}

void add_material(Draft& draft) {
    Model& model = draft.model;
    const GltfScene& scene = draft.scene;
    tinygltf::Material material;
    material.name = scene.texture.empty() ? "stone" : "photograph";
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    if (scene.texture.empty()) {
        // Colours of vertices are multiplied with it.
        material.pbrMetallicRoughness.baseColorFactor =
            has_colours(scene) ? std::vector<double>{1.0, 1.0, 1.0, 1.0}
                               : std::vector<double>{0.5, 0.48, 0.45, 1.0};
    } else {
        tinygltf::Image image;
        image.name = "photograph";
        image.mimeType = mime_type(scene.texture);
        image.bufferView = static_cast<int>(model.bufferViews.size());
        draft.sections.texture.parts = {scene.texture};
        draft.sections.texture.size = padded(scene.texture.size());
        draft.close(draft.sections.texture);
        model.images.push_back(std::move(image));
        tinygltf::Sampler sampler;  // pictures have no power-of-two size: no repeats
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        model.samplers.push_back(sampler);
        tinygltf::Texture texture;
        texture.source = 0;
        texture.sampler = 0;
        model.textures.push_back(texture);
        material.pbrMetallicRoughness.baseColorTexture.index = 0;
    }
    model.materials.push_back(std::move(material));
}

// ---- nodes ----

template <class T>
void append_floats(std::vector<std::uint8_t>& bytes, std::initializer_list<T> values) {
    for (const T v : values) {
        const auto number = static_cast<float>(v);
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof number);
        std::memcpy(bytes.data() + at, &number, sizeof number);
    }
}

// Copies as attributes of the node. They are placed before the node's own transform, so the unit
// of stored positions goes into their scale.
void add_copies(Draft& draft, const GltfNode& node, NodeText& text) {
    std::vector<std::uint8_t> translations;
    std::vector<std::uint8_t> rotations;
    std::vector<std::uint8_t> scales;
    const double unit = draft.unit_of(node);
    for (const GltfTransform& t : node.instances) {
        const glm::quat q = t.rotation / glm::length(t.rotation);
        append_floats(translations, {t.translation.x, t.translation.y, t.translation.z});
        append_floats(rotations, {q.x, q.y, q.z, q.w});
        append_floats(scales, {t.scale.x * unit, t.scale.y * unit, t.scale.z * unit});
    }
    const auto add = [&](std::vector<std::uint8_t>& bytes, int type) {
        return gltf::add_accessor(
            draft.accessors, draft.sections.instances, std::move(bytes),
            accessor_of(type, TINYGLTF_COMPONENT_TYPE_FLOAT, node.instances.size()));
    };
    text.translations = add(translations, TINYGLTF_TYPE_VEC3);
    text.rotations = add(rotations, TINYGLTF_TYPE_VEC4);
    text.scales = add(scales, TINYGLTF_TYPE_VEC3);
}

// The scene's own nodes keep their indices; copies as plain nodes follow behind them.
void add_nodes(Draft& draft) {
    const std::vector<GltfNode>& sources = draft.scene.nodes;
    auto n_nodes = static_cast<int>(sources.size());
    for (const GltfNode& source : sources) {
        NodeText text{.mesh = source.mesh, .unit = draft.unit_of(source), .extras = &source};
        if (!source.instances.empty()) {
            text.unit = 1.0;
            if (draft.options.instancing) {
                add_copies(draft, source, text);
            } else {
                text.mesh = -1;
                text.first_child = n_nodes;
                text.n_children = static_cast<int>(source.instances.size());
                n_nodes += text.n_children;
            }
        }
        begin_entry(draft.nodes);
        gltf::append_node(draft.nodes, source.name, source.transform, text);
    }
    if (draft.options.instancing)
        return;
    for (const GltfNode& source : sources) {
        for (std::size_t i = 0; i < source.instances.size(); ++i) {
            begin_entry(draft.nodes);
            gltf::append_node(draft.nodes, source.name + "." + std::to_string(i),
                              source.instances[i],
                              {.mesh = source.mesh, .unit = draft.unit_of(source)});
        }
    }
}

// Nodes that others name as their coarser selves are drawn in their stead, never beside them.
void add_scene(Draft& draft) {
    const GltfScene& source = draft.scene;
    std::set<int> stand_ins;
    for (const GltfNode& node : source.nodes)
        stand_ins.insert(node.coarser.begin(), node.coarser.end());
    tinygltf::Scene scene;
    scene.name = source.name.empty() ? "scene" : source.name;
    for (int i = 0; i < static_cast<int>(source.nodes.size()); ++i)
        if (!stand_ins.contains(i))
            scene.nodes.push_back(i);
    scene.extras = gltf::extras_value(source.extras);
    draft.model.scenes.push_back(std::move(scene));
    draft.model.defaultScene = 0;
}

void declare_extensions(Draft& draft) {
    Model& model = draft.model;
    const auto& nodes = draft.scene.nodes;
    const auto declare = [&](const char* name, bool required) {
        model.extensionsUsed.emplace_back(name);
        if (required)
            model.extensionsRequired.emplace_back(name);
    };
    if (draft.options.quantise && !draft.scene.meshes.empty())
        declare(kQuantisation, true);
    if (draft.options.instancing &&
        std::any_of(nodes.begin(), nodes.end(), [](const auto& n) { return !n.instances.empty(); }))
        declare(kInstancing, true);
    if (std::any_of(nodes.begin(), nodes.end(), [](const auto& n) { return !n.coarser.empty(); }))
        declare(kLod, false);
}

// ---- file ----

void append_word(std::vector<std::uint8_t>& bytes, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

// What tinygltf says of all but the long arrays, as if the buffer had so many bytes.
std::string model_text(Model& model, std::size_t n_bytes) {
    constexpr std::string_view kOne = R"("buffers":[{"byteLength":1}])";
    if (n_bytes > 0)
        model.buffers[0].data.assign(1, 0);
    else
        model.buffers.clear();
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, stream, false, true))
        fail<InvalidInput>("the scene cannot be written as binary glTF");
    const std::string_view glb = stream.view();
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    std::string json(glb.substr(20, length));
    if (n_bytes > 0)  // quotes in names are escaped, so this stands in one place only
        json.replace(json.find(kOne) + kOne.size() - 3, 1, std::to_string(n_bytes));
    return json;
}

std::string json_of(Draft& draft) {
    std::string accessors;
    for (const Accessor& accessor : draft.accessors) {
        begin_entry(accessors);
        gltf::append_accessor(accessors, accessor);
    }
    std::string json = "{";
    for (auto [name, array] :
         {std::pair{"accessors", &accessors}, {"meshes", &draft.meshes}, {"nodes", &draft.nodes}}) {
        if (!array->empty())
            json.append("\"").append(name).append("\":[").append(*array).append("],");
        *array = {};
    }
    json += std::string_view(model_text(draft.model, draft.n_bytes)).substr(1);
    json.resize(padded(json.size()), ' ');
    return json;
}

// Container, JSON, bytes.
void put_file(Draft& draft, const GlbSink& sink) {
    constexpr std::size_t kJson = 0x4E4F534A;
    constexpr std::size_t kBinary = 0x004E4942;
    const std::string json = json_of(draft);
    std::vector<std::uint8_t> head = {'g', 'l', 'T', 'F', 2, 0, 0, 0};
    append_word(head, 20 + json.size() + (draft.n_bytes == 0 ? 0 : 8 + draft.n_bytes));
    append_word(head, json.size());
    append_word(head, kJson);
    sink(head);
    sink(std::span(reinterpret_cast<const std::uint8_t*>(json.data()), json.size()));
    if (draft.n_bytes == 0)
        return;
    head.clear();
    append_word(head, draft.n_bytes);
    append_word(head, kBinary);
    sink(head);
    Sections& s = draft.sections;
    const std::array<std::uint8_t, 3> zeros{};
    for (Section* section : {&s.texture, &s.positions, &s.normals, &s.texcoords, &s.wide_texcoords,
                             &s.colours, &s.indices, &s.wide_indices, &s.instances}) {
        for (auto& part : section->parts) {
            sink(part);
            sink(std::span(zeros).first(padded(part.size()) - part.size()));
            part = {};
        }
    }
}

}  // namespace

void encode_glb(GltfScene scene, const GltfWriteOptions& options, const GlbSink& sink) {
    check(options);
    check_scene(scene);
    if (options.reorder && has_colours(scene))
        fail<InvalidInput>("meshes with colours keep their order: turn off reorder");
    std::vector<EncodedMesh> encoded = encode_meshes(scene, options);
    Draft draft{scene, options};
    draft.model.asset.version = "2.0";
    draft.model.asset.generator = "scree";
    draft.model.buffers.resize(1);
    draft.sections = gltf::open_sections(options.quantise);
    if (!scene.meshes.empty())
        add_material(draft);
    add_meshes(draft, std::move(encoded));
    add_nodes(draft);
    const Sections& s = draft.sections;
    for (const Section* section : {&s.positions, &s.normals, &s.texcoords, &s.wide_texcoords,
                                   &s.colours, &s.indices, &s.wide_indices, &s.instances})
        draft.close(*section);
    add_scene(draft);
    declare_extensions(draft);
    put_file(draft, sink);
}

std::vector<std::uint8_t> encode_glb(GltfScene scene, const GltfWriteOptions& options) {
    std::vector<std::uint8_t> glb;
    encode_glb(std::move(scene), options, [&](std::span<const std::uint8_t> bytes) {
        glb.insert(glb.end(), bytes.begin(), bytes.end());
    });
    return glb;
}

}  // namespace scree::meshing
