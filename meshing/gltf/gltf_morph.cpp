#include "meshing/gltf/gltf_morph.h"

#include "base/error.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <sstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tiny_gltf.h>

namespace scree::meshing {
namespace {

using Vectors = std::vector<glm::vec3>;

template <class Value>
std::vector<std::uint8_t> bytes_of(std::span<const Value> values) {
    std::vector<std::uint8_t> bytes(values.size_bytes());
    if (!bytes.empty())
        std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

void check_morph(const MorphScene& scene) {
    check_mesh(scene.mesh);
    if (scene.mesh.triangles.empty() || scene.shapes.empty())
        fail<InvalidInput>("a morph needs a mesh with triangles and at least one earlier shape");
    if (!(scene.seconds > 0.0) || !std::isfinite(scene.seconds))
        fail<InvalidInput>("a morph takes ", scene.seconds, " s; it must be positive");
    for (const MorphShape& shape : scene.shapes) {
        if (shape.positions.size() != scene.mesh.positions.size())
            fail<InvalidInput>("shape ", shape.name, " has ", shape.positions.size(),
                               " vertices, the mesh ", scene.mesh.positions.size());
        for (const glm::vec3& p : shape.positions)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                fail<InvalidInput>("shape ", shape.name, " has a place that is not finite");
    }
}

Vectors normals_of(const TriMesh& mesh, const Vectors& positions) {
    Vectors sums(positions.size(), glm::vec3(0.0F));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 area =
            glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
        for (int c = 0; c < 3; ++c)
            sums[t[c]] += area;
    }
    for (glm::vec3& n : sums) {
        const glm::dvec3 wide(n);
        const double length = glm::length(wide);
        n = length > 0.0 ? glm::vec3(wide / length) : glm::vec3(0, 1, 0);
    }
    return sums;
}

Vectors difference(const Vectors& a, const Vectors& b) {
    Vectors d(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        d[i] = a[i] - b[i];
    return d;
}

tinygltf::Accessor accessor_of(int type, int component, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.type = type;
    accessor.componentType = component;
    accessor.count = count;
    return accessor;
}

// Bytes at the end of the buffer, in a view of their own.
// @param target  0: neither vertices nor indices.
int add_accessor(tinygltf::Model& model, const std::vector<std::uint8_t>& bytes,
                 tinygltf::Accessor accessor, int target) {
    std::vector<std::uint8_t>& buffer = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = bytes.size();
    view.target = target;
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    buffer.resize((buffer.size() + 3) / 4 * 4, 0);
    accessor.bufferView = static_cast<int>(model.bufferViews.size());
    model.bufferViews.push_back(view);
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size()) - 1;
}

int add_vectors(tinygltf::Model& model, const Vectors& values, bool bounds) {
    auto accessor = accessor_of(TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, values.size());
    if (bounds) {
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        for (const glm::vec3& v : values) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        accessor.minValues = {low.x, low.y, low.z};
        accessor.maxValues = {high.x, high.y, high.z};
    }
    return add_accessor(model, bytes_of(std::span<const glm::vec3>(values)), std::move(accessor),
                        TINYGLTF_TARGET_ARRAY_BUFFER);
}

int add_scalars(tinygltf::Model& model, const std::vector<float>& values, bool bounds) {
    auto accessor = accessor_of(TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_FLOAT, values.size());
    if (bounds) {
        accessor.minValues = {values.front()};
        accessor.maxValues = {values.back()};
    }
    return add_accessor(model, bytes_of(std::span<const float>(values)), std::move(accessor), 0);
}

void add_mesh(tinygltf::Model& model, const MorphScene& scene) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    const Vectors normals = normals_of(scene.mesh, scene.mesh.positions);
    primitive.attributes["POSITION"] = add_vectors(model, scene.mesh.positions, true);
    primitive.attributes["NORMAL"] = add_vectors(model, normals, false);
    tinygltf::Mesh mesh;
    mesh.name = scene.name;
    tinygltf::Value::Array names;
    for (const MorphShape& shape : scene.shapes) {
        const Vectors moved = difference(shape.positions, scene.mesh.positions);
        const Vectors turned = difference(normals_of(scene.mesh, shape.positions), normals);
        primitive.targets.push_back({{"POSITION", add_vectors(model, moved, true)},
                                     {"NORMAL", add_vectors(model, turned, false)}});
        mesh.weights.push_back(0.0);
        names.emplace_back(shape.name);
    }
    const std::span<const glm::uvec3> triangles(scene.mesh.triangles);
    primitive.indices =
        add_accessor(model, bytes_of(triangles),
                     accessor_of(TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                 3 * triangles.size()),
                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    mesh.primitives.push_back(std::move(primitive));
    mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
    model.meshes.push_back(std::move(mesh));
}

// At equal times one shape has all the weight; at the last none has, which shows the mesh.
void add_animation(tinygltf::Model& model, const MorphScene& scene) {
    const std::size_t n = scene.shapes.size();
    std::vector<float> times;
    std::vector<float> weights;
    for (std::size_t key = 0; key <= n; ++key) {
        times.push_back(
            static_cast<float>(scene.seconds * static_cast<double>(key) / static_cast<double>(n)));
        for (std::size_t shape = 0; shape < n; ++shape)
            weights.push_back(shape == key ? 1.0F : 0.0F);
    }
    tinygltf::AnimationSampler sampler;
    sampler.input = add_scalars(model, times, true);
    sampler.output = add_scalars(model, weights, false);
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = 0;
    channel.target_path = "weights";
    tinygltf::Animation animation;
    animation.name = "erosion";
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
    model.animations.push_back(std::move(animation));
}

}  // namespace

std::vector<std::uint8_t> encode_morph_glb(const MorphScene& scene) {
    check_morph(scene);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "scree";
    model.buffers.emplace_back();
    tinygltf::Material material;
    material.name = "stone";
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    material.pbrMetallicRoughness.baseColorFactor = {0.5, 0.48, 0.45, 1.0};
    model.materials.push_back(material);
    add_mesh(model, scene);
    add_animation(model, scene);
    tinygltf::Node node;
    node.name = scene.name;
    node.mesh = 0;
    model.nodes.push_back(node);
    tinygltf::Scene root;
    root.name = scene.name;
    root.nodes = {0};
    model.scenes.push_back(root);
    model.defaultScene = 0;

    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, stream, false, true))
        fail<InvalidInput>("the morph cannot be written as binary glTF");
    const std::string_view bytes = stream.view();
    return {bytes.begin(), bytes.end()};
}

}  // namespace scree::meshing
