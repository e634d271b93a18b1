#include "meshing/gltf/gltf_read.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "meshing/gltf/glb_parse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace scree::meshing {
namespace {

using gltf::ElementReader;
using tinygltf::Model;

void check_extensions(const Model& model) {
    static const std::set<std::string> known = {gltf::kInstancing, gltf::kQuantisation};
    for (const std::string& name : model.extensionsRequired)
        if (!known.contains(name))
            fail<InvalidInput>("it needs the extension ", name, ", which is not known here");
}

ElementReader open_accessor(const Model& model, int index, int components, const char* what) {
    const std::string fault = gltf::accessor_fault(model, index);
    if (!fault.empty())
        fail<InvalidInput>("accessor ", index, " (", what, ") ", fault);
    ElementReader reader(model, index);
    if (reader.components() != components)
        fail<InvalidInput>("accessor ", index, " (", what, ") has ", reader.components(),
                           " components, ", components, " are needed");
    return reader;
}

const int* attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? nullptr : &found->second;
}

struct Budget {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t placements = 0;

    void spend(std::size_t Budget::*what, std::size_t n, const char* name) {
        if (n > this->*what)
            fail<InvalidInput>("it holds more ", name, " than the limit allows");
        this->*what -= n;
    }
};

// Append the vertices of a primitive; attributes that not all parts of the mesh have are dropped
// by the caller.
void append_vertices(const Model& model, const tinygltf::Primitive& primitive, TriMesh& mesh,
                     Budget& budget) {
    const int* const position = attribute(primitive, "POSITION");
    if (position == nullptr)
        fail<InvalidInput>("a mesh has no POSITION");
    const ElementReader positions = open_accessor(model, *position, 3, "POSITION");
    budget.spend(&Budget::vertices, positions.count(), "vertices");
    for (std::size_t i = 0; i < positions.count(); ++i)
        mesh.positions.emplace_back(positions.at(i, 0), positions.at(i, 1), positions.at(i, 2));
    if (const int* const index = attribute(primitive, "NORMAL")) {
        const ElementReader normals = open_accessor(model, *index, 3, "NORMAL");
        for (std::size_t i = 0; i < std::min(normals.count(), positions.count()); ++i) {
            const glm::dvec3 n(normals.at(i, 0), normals.at(i, 1), normals.at(i, 2));
            const double length = glm::length(n);
            mesh.normals.emplace_back(length > 0.0 ? n / length : n);
        }
    }
    if (const int* const index = attribute(primitive, "TEXCOORD_0")) {
        const ElementReader texcoords = open_accessor(model, *index, 2, "TEXCOORD_0");
        for (std::size_t i = 0; i < std::min(texcoords.count(), positions.count()); ++i)
            mesh.texcoords.emplace_back(texcoords.at(i, 0), texcoords.at(i, 1));
    }
}

void append_triangles(const Model& model, const tinygltf::Primitive& primitive,
                      std::size_t first_vertex, TriMesh& mesh, Budget& budget) {
    const std::size_t n_vertices = mesh.positions.size() - first_vertex;
    const auto push = [&](std::size_t n_indices, const auto& index_at) {
        budget.spend(&Budget::triangles, n_indices / 3, "triangles");
        for (std::size_t i = 0; i + 2 < n_indices; i += 3) {
            glm::uvec3 triangle;
            for (int k = 0; k < 3; ++k) {
                const double v = index_at(i + static_cast<std::size_t>(k));
                if (!(v >= 0.0 && v < static_cast<double>(n_vertices)))
                    fail<InvalidInput>("a triangle names vertex ", v, ", its mesh has ",
                                       n_vertices);
                triangle[k] =
                    static_cast<std::uint32_t>(first_vertex + static_cast<std::size_t>(v));
            }
            mesh.triangles.push_back(triangle);
        }
    };
    if (primitive.indices < 0) {
        push(n_vertices, [](std::size_t i) { return static_cast<double>(i); });
        return;
    }
    const ElementReader indices = open_accessor(model, primitive.indices, 1, "indices");
    push(indices.count(), [&](std::size_t i) { return indices.stored(i, 0); });
}

GltfMesh load_mesh(const Model& model, const tinygltf::Mesh& source, Budget& budget) {
    GltfMesh mesh;
    mesh.name = source.name;
    TriMesh& geometry = mesh.geometry;
    for (const tinygltf::Primitive& primitive : source.primitives) {
        if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1)
            fail<InvalidInput>("mesh ", source.name, " is drawn in mode ", primitive.mode,
                               ", only triangle lists are read");
        const std::size_t first = geometry.positions.size();
        append_vertices(model, primitive, geometry, budget);
        append_triangles(model, primitive, first, geometry, budget);
    }
    if (geometry.normals.size() != geometry.positions.size())
        geometry.normals.clear();
    if (geometry.texcoords.size() != geometry.positions.size())
        geometry.texcoords.clear();
    check_mesh(geometry);
    return mesh;
}

glm::dmat4 placed(const glm::dvec3& translation, const glm::dquat& rotation,
                  const glm::dvec3& scale) {
    return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(rotation) *
           glm::scale(glm::dmat4(1.0), scale);
}

glm::dmat4 local_matrix(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    const auto vector = [](const std::vector<double>& v, double otherwise) {
        return v.size() == 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(otherwise);
    };
    const auto& r = node.rotation;
    const glm::dquat rotation =
        r.size() == 4 ? glm::dquat(r[3], r[0], r[1], r[2]) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    return placed(vector(node.translation, 0.0), rotation, vector(node.scale, 1.0));
}

struct CopyReaders {
    std::vector<ElementReader> translation, rotation, scale;  // none or one of each
    std::size_t count = 0;
};

CopyReaders open_copies(const Model& model, const tinygltf::Node& node) {
    const gltf::InstanceAccessors indices = gltf::instance_accessors(node);
    if (!indices.fault.empty())
        fail<InvalidInput>("the instancing of node ", node.name, " ", indices.fault);
    CopyReaders readers;
    const auto open = [&](int index, int components, const char* what,
                          std::vector<ElementReader>& out) {
        if (index < 0)
            return;
        out.push_back(open_accessor(model, index, components, what));
        if (readers.count != 0 && readers.count != out[0].count())
            fail<InvalidInput>("the instancing of node ", node.name,
                               " has attributes of different lengths");
        readers.count = out[0].count();
    };
    open(indices.translation, 3, "TRANSLATION", readers.translation);
    open(indices.rotation, 4, "ROTATION", readers.rotation);
    open(indices.scale, 3, "SCALE", readers.scale);
    return readers;
}

glm::dmat4 copy_matrix(const CopyReaders& readers, std::size_t i) {
    glm::dvec3 translation(0.0);
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    glm::dvec3 scale(1.0);
    for (const ElementReader& r : readers.translation)
        translation = {r.at(i, 0), r.at(i, 1), r.at(i, 2)};
    for (const ElementReader& r : readers.rotation)
        rotation = {r.at(i, 3), r.at(i, 0), r.at(i, 1), r.at(i, 2)};
    for (const ElementReader& r : readers.scale)
        scale = {r.at(i, 0), r.at(i, 1), r.at(i, 2)};
    return placed(translation, rotation, scale);
}

void add_placement(const tinygltf::Node& node, std::size_t mesh, const glm::dmat4& world,
                   LoadedGltf& out) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(world[i / 4][i % 4]))
            fail<InvalidInput>("node ", node.name, " stands at a place that is no number");
    out.placements.push_back({node.name, mesh, world});
}

void place_node(const Model& model, const tinygltf::Node& node, const glm::dmat4& world,
                LoadedGltf& out, Budget& budget) {
    if (node.mesh < 0)
        return;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    if (mesh >= out.meshes.size())
        fail<InvalidInput>("node ", node.name, " names mesh ", mesh, ", the file has ",
                           out.meshes.size());
    if (!node.extensions.contains(gltf::kInstancing)) {
        budget.spend(&Budget::placements, 1, "placed meshes");
        add_placement(node, mesh, world, out);
        return;
    }
    const CopyReaders readers = open_copies(model, node);
    budget.spend(&Budget::placements, readers.count, "placed meshes");
    for (std::size_t i = 0; i < readers.count; ++i)
        add_placement(node, mesh, world * copy_matrix(readers, i), out);
}

}  // namespace

LoadedGltf decode_glb(std::span<const std::uint8_t> bytes, const GltfLimits& limits) {
    const Model model = gltf::parse_glb(bytes, limits);
    check_extensions(model);
    Budget budget{limits.max_vertices, limits.max_triangles, limits.max_placements};
    LoadedGltf loaded;
    for (const tinygltf::Mesh& mesh : model.meshes)
        loaded.meshes.push_back(load_mesh(model, mesh, budget));
    const gltf::NodeOrder order = gltf::node_order(model);
    if (!order.fault.empty())
        fail<InvalidInput>(order.fault);
    std::vector<glm::dmat4> world(model.nodes.size(), glm::dmat4(1.0));
    for (std::size_t i = 0; i < order.nodes.size(); ++i) {
        const std::size_t node = order.nodes[i];
        const int parent = order.parents[i];
        world[node] = local_matrix(model.nodes[node]);
        if (parent >= 0)
            world[node] = world[static_cast<std::size_t>(parent)] * world[node];
        place_node(model, model.nodes[node], world[node], loaded, budget);
    }
    return loaded;
}

LoadedGltf read_glb(const std::filesystem::path& path, const GltfLimits& limits) {
    const std::string bytes = read_whole_file(path, limits.max_bytes);
    try {
        return decode_glb({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                          limits);
    } catch (const InvalidInput& error) {
        fail<InvalidInput>(path.string(), " cannot be read: ", error.what());
    }
}

}  // namespace scree::meshing
