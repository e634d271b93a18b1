#include "meshing/gltf/gltf_write.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/gltf/glb_parse.h"
#include "meshing/gltf/glb_sections.h"
#include "meshing/gltf/mesh_encoding.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <sstream>
#include <utility>

#include <glm/geometric.hpp>
#include <tiny_gltf.h>

namespace scree::meshing {
namespace {

using gltf::accessor_of;
using gltf::add_accessor;
using gltf::close_section;
using gltf::EncodedMesh;
using gltf::kInstancing;
using gltf::kLod;
using gltf::kQuantisation;
using gltf::Section;
using gltf::Sections;
using tinygltf::Model;
using tinygltf::Value;

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

// ---- meshes ----

tinygltf::Primitive add_primitive(Model& model, Sections& sections, const EncodedMesh& mesh,
                                  bool quantise) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    auto positions =
        accessor_of(TINYGLTF_TYPE_VEC3,
                    quantise ? TINYGLTF_COMPONENT_TYPE_SHORT : TINYGLTF_COMPONENT_TYPE_FLOAT,
                    mesh.n_vertices, quantise);
    positions.minValues = {mesh.low.x, mesh.low.y, mesh.low.z};
    positions.maxValues = {mesh.high.x, mesh.high.y, mesh.high.z};
    primitive.attributes["POSITION"] =
        add_accessor(model, sections.positions, mesh.positions, positions);
    if (!mesh.normals.empty())
        primitive.attributes["NORMAL"] = add_accessor(
            model, sections.normals, mesh.normals,
            accessor_of(TINYGLTF_TYPE_VEC3,
                        quantise ? TINYGLTF_COMPONENT_TYPE_BYTE : TINYGLTF_COMPONENT_TYPE_FLOAT,
                        mesh.n_vertices, quantise));
    if (!mesh.texcoords.empty())
        primitive.attributes["TEXCOORD_0"] =
            add_accessor(model, mesh.coded_texcoords ? sections.texcoords : sections.wide_texcoords,
                         mesh.texcoords,
                         accessor_of(TINYGLTF_TYPE_VEC2,
                                     mesh.coded_texcoords ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                                          : TINYGLTF_COMPONENT_TYPE_FLOAT,
                                     mesh.n_vertices, mesh.coded_texcoords));
    if (!mesh.colours.empty())
        primitive.attributes["COLOR_0"] =
            add_accessor(model, sections.colours, mesh.colours,
                         accessor_of(TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                     mesh.n_vertices, true));
    primitive.indices = add_accessor(
        model, mesh.wide_indices ? sections.wide_indices : sections.indices, mesh.indices,
        accessor_of(TINYGLTF_TYPE_SCALAR,
                    mesh.wide_indices ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT
                                      : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                    mesh.n_indices));
    return primitive;
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

// ---- material ----

bool has_colours(const GltfScene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                       [](const GltfMesh& mesh) { return !mesh.colours.empty(); });
}

void add_material(Model& model, const GltfScene& scene) {
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
        Section section;
        section.bytes = scene.texture;
        close_section(model, section);
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

Value value_of(const GltfExtra& extra) {
    if (const auto* number = std::get_if<double>(&extra.value))
        return Value(*number);
    if (const auto* flag = std::get_if<bool>(&extra.value))
        return Value(*flag);
    if (const auto* text = std::get_if<std::string>(&extra.value))
        return Value(*text);
    Value::Array array;
    for (const double v : std::get<std::vector<double>>(extra.value))
        array.emplace_back(v);
    return Value(array);
}

Value value_of(const std::vector<GltfExtra>& extras) {
    if (extras.empty())
        return Value();
    Value::Object object;
    for (const GltfExtra& extra : extras)
        object[extra.name] = value_of(extra);
    return Value(object);
}

// The node's transform; parts that change nothing are left out. `unit` is the metres that a stored
// position of 1 stands for.
void place(tinygltf::Node& node, const GltfTransform& t, double unit) {
    const glm::vec3& p = t.translation;
    if (p != glm::vec3(0.0F))
        node.translation = {p.x, p.y, p.z};
    const glm::quat& q = t.rotation;
    if (q.x != 0.0F || q.y != 0.0F || q.z != 0.0F)
        node.rotation = {q.x, q.y, q.z, q.w};
    const glm::dvec3 s = glm::dvec3(t.scale) * unit;
    if (s != glm::dvec3(1.0))
        node.scale = {s.x, s.y, s.z};
}

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
Value instancing_of(Model& model, Sections& sections, const GltfNode& node, double unit) {
    std::vector<std::uint8_t> translations;
    std::vector<std::uint8_t> rotations;
    std::vector<std::uint8_t> scales;
    for (const GltfTransform& t : node.instances) {
        const glm::quat q = t.rotation / glm::length(t.rotation);
        append_floats(translations, {t.translation.x, t.translation.y, t.translation.z});
        append_floats(rotations, {q.x, q.y, q.z, q.w});
        append_floats(scales, {t.scale.x * unit, t.scale.y * unit, t.scale.z * unit});
    }
    const auto add = [&](const std::vector<std::uint8_t>& bytes, int type) {
        return Value(
            add_accessor(model, sections.instances, bytes,
                         accessor_of(type, TINYGLTF_COMPONENT_TYPE_FLOAT, node.instances.size())));
    };
    Value::Object attributes;
    attributes["TRANSLATION"] = add(translations, TINYGLTF_TYPE_VEC3);
    attributes["ROTATION"] = add(rotations, TINYGLTF_TYPE_VEC4);
    attributes["SCALE"] = add(scales, TINYGLTF_TYPE_VEC3);
    Value::Object extension;
    extension["attributes"] = Value(attributes);
    return Value(extension);
}

// A node without a mesh whose children are the copies.
void add_plain_copies(Model& model, const GltfNode& source, std::size_t parent, double unit) {
    model.nodes[parent].mesh = -1;
    for (std::size_t i = 0; i < source.instances.size(); ++i) {
        tinygltf::Node copy;
        copy.name = source.name + "." + std::to_string(i);
        copy.mesh = source.mesh;
        place(copy, source.instances[i], unit);
        model.nodes[parent].children.push_back(static_cast<int>(model.nodes.size()));
        model.nodes.push_back(std::move(copy));
    }
}

struct Context {
    const GltfScene& scene;
    const GltfWriteOptions& options;
    const std::vector<EncodedMesh>& encoded;
};

// The scene's own nodes keep their indices; plain copies follow behind them.
void add_nodes(Model& model, Sections& sections, const Context& context) {
    const std::vector<GltfNode>& sources = context.scene.nodes;
    const auto unit_of = [&](const GltfNode& node) {
        return node.mesh < 0 ? 1.0 : context.encoded[static_cast<std::size_t>(node.mesh)].scale;
    };
    model.nodes.resize(sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const GltfNode& source = sources[i];
        tinygltf::Node& node = model.nodes[i];
        node.name = source.name;
        node.mesh = source.mesh;
        node.extras = value_of(source.extras);
        place(node, source.transform, source.instances.empty() ? unit_of(source) : 1.0);
        if (!source.instances.empty() && context.options.instancing)
            node.extensions[kInstancing] = instancing_of(model, sections, source, unit_of(source));
        if (!source.coarser.empty()) {
            Value::Array ids;
            for (const int id : source.coarser)
                ids.emplace_back(id);
            node.extensions[kLod] = Value(Value::Object{{"ids", Value(ids)}});
        }
    }
    for (std::size_t i = 0; i < sources.size(); ++i)
        if (!sources[i].instances.empty() && !context.options.instancing)
            add_plain_copies(model, sources[i], i, unit_of(sources[i]));
}

// Nodes that others name as their coarser selves are drawn in their stead, never beside them.
void add_scene(Model& model, const GltfScene& source) {
    std::set<int> stand_ins;
    for (const GltfNode& node : source.nodes)
        stand_ins.insert(node.coarser.begin(), node.coarser.end());
    tinygltf::Scene scene;
    scene.name = source.name.empty() ? "scene" : source.name;
    for (int i = 0; i < static_cast<int>(source.nodes.size()); ++i)
        if (!stand_ins.contains(i))
            scene.nodes.push_back(i);
    scene.extras = value_of(source.extras);
    model.scenes.push_back(std::move(scene));
    model.defaultScene = 0;
}

void declare_extensions(Model& model, const Context& context) {
    const auto& nodes = context.scene.nodes;
    const auto declare = [&](const char* name, bool required) {
        model.extensionsUsed.emplace_back(name);
        if (required)
            model.extensionsRequired.emplace_back(name);
    };
    if (context.options.quantise && !context.scene.meshes.empty())
        declare(kQuantisation, true);
    if (context.options.instancing &&
        std::any_of(nodes.begin(), nodes.end(), [](const auto& n) { return !n.instances.empty(); }))
        declare(kInstancing, true);
    if (std::any_of(nodes.begin(), nodes.end(), [](const auto& n) { return !n.coarser.empty(); }))
        declare(kLod, false);
}

void append_word(std::vector<std::uint8_t>& bytes, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

// The JSON of the model, as if its buffer had so many bytes.
std::string json_of(Model& model, std::size_t n_bytes) {
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
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return json;
}

// Container, JSON, bytes. The writer of the JSON would copy the bytes three times, so it sees none.
std::vector<std::uint8_t> serialised(Model& model) {
    constexpr std::size_t kJson = 0x4E4F534A;
    constexpr std::size_t kBinary = 0x004E4942;
    const std::vector<unsigned char> binary = std::exchange(model.buffers[0].data, {});
    const std::string json = json_of(model, binary.size());
    std::vector<std::uint8_t> glb = {'g', 'l', 'T', 'F', 2, 0, 0, 0};
    const std::size_t size = 20 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
    glb.reserve(size);
    append_word(glb, size);
    append_word(glb, json.size());
    append_word(glb, kJson);
    glb.insert(glb.end(), json.begin(), json.end());
    if (binary.empty())
        return glb;
    append_word(glb, binary.size());
    append_word(glb, kBinary);
    glb.insert(glb.end(), binary.begin(), binary.end());
    return glb;
}

// Room for all meshes at once: growing bit by bit would take twice the memory on the way.
void reserve_sections(Sections& sections, Model& model, const std::vector<EncodedMesh>& encoded) {
    std::size_t positions = 0;
    std::size_t normals = 0;
    std::size_t texcoords = 0;
    std::size_t wide_texcoords = 0;
    std::size_t indices = 0;
    std::size_t wide_indices = 0;
    constexpr std::size_t kPadding = 3;
    for (const EncodedMesh& mesh : encoded) {
        positions += mesh.positions.size() + kPadding;
        normals += mesh.normals.size() + kPadding;
        (mesh.coded_texcoords ? texcoords : wide_texcoords) += mesh.texcoords.size() + kPadding;
        (mesh.wide_indices ? wide_indices : indices) += mesh.indices.size() + kPadding;
    }
    sections.positions.bytes.reserve(positions);
    sections.normals.bytes.reserve(normals);
    sections.texcoords.bytes.reserve(texcoords);
    sections.wide_texcoords.bytes.reserve(wide_texcoords);
    sections.indices.bytes.reserve(indices);
    sections.wide_indices.bytes.reserve(wide_indices);
    model.buffers[0].data.reserve(model.buffers[0].data.size() + positions + normals + texcoords +
                                  wide_texcoords + indices + wide_indices);
}

// Moves the meshes' bytes into the sections, and those into the model's buffer.
void add_meshes(Model& model, Sections& sections, const Context& context,
                std::vector<EncodedMesh>& encoded) {
    reserve_sections(sections, model, encoded);
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        tinygltf::Mesh mesh;
        mesh.name = context.scene.meshes[i].name;
        mesh.primitives.push_back(
            add_primitive(model, sections, encoded[i], context.options.quantise));
        model.meshes.push_back(std::move(mesh));
        encoded[i].release();
    }
}

}  // namespace

std::vector<std::uint8_t> encode_glb(GltfScene scene, const GltfWriteOptions& options) {
    check(options);
    check_scene(scene);
    if (options.reorder && has_colours(scene))
        fail<InvalidInput>("meshes with colours keep their order: turn off reorder");
    std::vector<EncodedMesh> encoded = encode_meshes(scene, options);
    const Context context{scene, options, encoded};
    Model model;
    model.asset.version = "2.0";
    model.asset.generator = "scree";
    model.buffers.resize(1);
    if (!scene.meshes.empty())
        add_material(model, scene);
    Sections sections = gltf::open_sections(options.quantise);
    add_meshes(model, sections, context, encoded);
    add_nodes(model, sections, context);
    for (Section* section :
         {&sections.positions, &sections.normals, &sections.texcoords, &sections.wide_texcoords,
          &sections.colours, &sections.indices, &sections.wide_indices, &sections.instances})
        close_section(model, *section);
    add_scene(model, scene);
    declare_extensions(model, context);
    return serialised(model);
}

}  // namespace scree::meshing
