#include "meshing/gltf/gltf_text.h"

#include "base/number_text.h"
#include "meshing/gltf/glb_parse.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

namespace scree::meshing::gltf {
namespace {

void append_text(std::string& json, std::string_view text) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c >= ' ' && c < 0x7f && c != '"' && c != '\\';
    });
    if (plain)
        json.append(1, '"').append(text).append(1, '"');
    else
        json += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// JSON has no word for what is no number.
template <class Number>
void append_finite(std::string& json, Number number) {
    if (std::isfinite(number))
        append_number(json, number);
    else
        json += "null";
}

template <class Number>
void append_list(std::string& json, std::span<const Number> numbers) {
    json += '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        json += i == 0 ? "" : ",";
        append_finite(json, numbers[i]);
    }
    json += ']';
}

// Opens an object and adds its members one by one.
class Object {
public:
    explicit Object(std::string& json) : json_(json) { json_ += '{'; }
    ~Object() { json_ += '}'; }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    std::string& key(std::string_view name) {
        json_ += first_ ? "\"" : ",\"";
        first_ = false;
        return json_.append(name).append("\":");
    }
    template <class Number>
    void number(std::string_view name, Number value) {
        append_number(key(name), value);
    }
    void index(std::string_view name, int value) {
        if (value >= 0)
            number(name, value);
    }

private:
    std::string& json_;
    bool first_ = true;
};

void append_extras(std::string& json, const std::vector<GltfExtra>& extras) {
    json += '{';
    for (const GltfExtra& extra : extras) {
        json += &extra == extras.data() ? "" : ",";
        append_text(json, extra.name);
        json += ':';
        if (const auto* number = std::get_if<double>(&extra.value))
            append_finite(json, *number);
        else if (const auto* flag = std::get_if<bool>(&extra.value))
            json += *flag ? "true" : "false";
        else if (const auto* text = std::get_if<std::string>(&extra.value))
            append_text(json, *text);
        else
            append_list(json, std::span<const double>(std::get<std::vector<double>>(extra.value)));
    }
    json += '}';
}

void append_extensions(std::string& json, const NodeText& node) {
    Object extensions(json);
    if (node.translations >= 0) {
        Object instancing(extensions.key(kInstancing));
        Object attributes(instancing.key("attributes"));
        attributes.index("ROTATION", node.rotations);
        attributes.index("SCALE", node.scales);
        attributes.index("TRANSLATION", node.translations);
    }
    if (node.extras != nullptr && !node.extras->coarser.empty()) {
        Object lod(extensions.key(kLod));
        append_list(lod.key("ids"), std::span<const int>(node.extras->coarser));
    }
}

const char* name_of_type(int type) {
    return type == TINYGLTF_TYPE_SCALAR ? "SCALAR"
           : type == TINYGLTF_TYPE_VEC2 ? "VEC2"
           : type == TINYGLTF_TYPE_VEC3 ? "VEC3"
                                        : "VEC4";
}

}  // namespace

void append_accessor(std::string& json, const Accessor& accessor) {
    Object object(json);
    object.number("bufferView", accessor.view);
    if (accessor.offset > 0)
        object.number("byteOffset", accessor.offset);
    object.number("componentType", accessor.component);
    object.number("count", accessor.count);
    if (accessor.bounded) {
        append_list(object.key("max"), std::span<const double>(&accessor.high.x, 3));
        append_list(object.key("min"), std::span<const double>(&accessor.low.x, 3));
    }
    if (accessor.normalised)
        object.key("normalized") += "true";
    append_text(object.key("type"), name_of_type(accessor.type));
}

void append_mesh(std::string& json, const std::string& name, const MeshText& mesh) {
    Object object(json);
    if (!name.empty())
        append_text(object.key("name"), name);
    object.key("primitives") += '[';
    {
        Object primitive(json);
        {
            Object attributes(primitive.key("attributes"));
            attributes.index("COLOR_0", mesh.colours);
            attributes.index("NORMAL", mesh.normals);
            attributes.index("POSITION", mesh.positions);
            attributes.index("TEXCOORD_0", mesh.texcoords);
        }
        primitive.index("indices", mesh.indices);
        primitive.number("material", 0);
        primitive.number("mode", TINYGLTF_MODE_TRIANGLES);
    }
    json += ']';
}

// Parts of the place that change nothing are left out.
void append_node(std::string& json, const std::string& name, const GltfTransform& place,
                 const NodeText& node) {
    Object object(json);
    if (node.n_children > 0) {
        object.key("children") += '[';
        for (int i = 0; i < node.n_children; ++i) {
            json += i == 0 ? "" : ",";
            append_number(json, node.first_child + i);
        }
        json += ']';
    }
    if (node.translations >= 0 || (node.extras != nullptr && !node.extras->coarser.empty()))
        append_extensions(object.key("extensions"), node);
    if (node.extras != nullptr && !node.extras->extras.empty())
        append_extras(object.key("extras"), node.extras->extras);
    object.index("mesh", node.mesh);
    if (!name.empty())
        append_text(object.key("name"), name);
    const glm::quat& q = place.rotation;
    if (q.x != 0.0F || q.y != 0.0F || q.z != 0.0F) {
        const double turn[] = {q.x, q.y, q.z, q.w};
        append_list(object.key("rotation"), std::span<const double>(turn));
    }
    const glm::dvec3 scale = glm::dvec3(place.scale) * node.unit;
    if (scale != glm::dvec3(1.0))
        append_list(object.key("scale"), std::span<const double>(&scale.x, 3));
    const glm::dvec3 p(place.translation);
    if (p != glm::dvec3(0.0))
        append_list(object.key("translation"), std::span<const double>(&p.x, 3));
}

}  // namespace scree::meshing::gltf
