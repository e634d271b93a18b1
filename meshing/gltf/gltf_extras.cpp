#include "meshing/gltf/gltf_extras.h"

namespace scree::meshing::gltf {

using tinygltf::Value;

namespace {

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

}  // namespace

Value extras_value(const std::vector<GltfExtra>& extras) {
    if (extras.empty())
        return Value();
    Value::Object object;
    for (const GltfExtra& extra : extras)
        object[extra.name] = value_of(extra);
    return Value(object);
}

}  // namespace scree::meshing::gltf
