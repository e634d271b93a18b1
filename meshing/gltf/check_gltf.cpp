#include "meshing/gltf/check_gltf.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "meshing/gltf/glb_parse.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace scree::meshing {
namespace {

using gltf::ElementReader;
using tinygltf::Model;

constexpr std::size_t kMostFindings = 100;
constexpr std::size_t kMostElements = 500'000'000;

class Findings {
public:
    template <class... Parts>
    void error(const std::string& where, const Parts&... parts) {
        add(GltfFinding::Severity::Error, where, parts...);
    }
    template <class... Parts>
    void warning(const std::string& where, const Parts&... parts) {
        add(GltfFinding::Severity::Warning, where, parts...);
    }
    std::vector<GltfFinding> take() { return std::move(list_); }

    // Whether another n elements may be looked at: a small file can name the same large accessor
    // a hundred thousand times.
    bool afford(std::size_t n) {
        if (n > budget_ && budget_ > 0)
            warning("", "is larger than what is checked, the rest was passed over");
        budget_ = n > budget_ ? 0 : budget_ - n;
        return budget_ > 0;
    }

private:
    template <class... Parts>
    void add(GltfFinding::Severity severity, const std::string& where, const Parts&... parts) {
        if (list_.size() >= kMostFindings)
            return;
        std::ostringstream text;
        (text << ... << parts);
        list_.push_back({severity, where, text.str()});
    }

    std::vector<GltfFinding> list_;
    std::size_t budget_ = kMostElements;
};

std::string named(const char* kind, std::size_t index) {
    return std::string(kind) + " " + std::to_string(index);
}

bool holds(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

// ---- extensions and files ----

void check_declared(const Model& model, const tinygltf::ExtensionMap& extensions,
                    const std::string& where, Findings& findings) {
    for (const auto& [name, value] : extensions)
        if (!holds(model.extensionsUsed, name))
            findings.error(where, "uses ", name, ", which extensionsUsed does not declare");
}

void check_extensions(const Model& model, Findings& findings) {
    static const std::set<std::string> known = {gltf::kInstancing, gltf::kQuantisation, gltf::kLod};
    for (const std::string& name : model.extensionsRequired) {
        if (!holds(model.extensionsUsed, name))
            findings.error("", "requires ", name, ", which extensionsUsed does not declare");
        if (!known.contains(name))
            findings.warning("", "requires ", name, ", which is not checked here");
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        check_declared(model, model.nodes[i].extensions, named("node", i), findings);
    for (std::size_t i = 0; i < model.meshes.size(); ++i)
        check_declared(model, model.meshes[i].extensions, named("mesh", i), findings);
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        check_declared(model, model.materials[i].extensions, named("material", i), findings);
}

void check_files(const Model& model, Findings& findings) {
    const auto outside = [](const std::string& uri) {
        return !uri.empty() && uri.rfind("data:", 0) != 0;
    };
    for (std::size_t i = 0; i < model.buffers.size(); ++i)
        if (outside(model.buffers[i].uri))
            findings.error(named("buffer", i), "lies in another file: ", model.buffers[i].uri);
    for (std::size_t i = 0; i < model.images.size(); ++i)
        if (outside(model.images[i].uri))
            findings.error(named("image", i), "lies in another file: ", model.images[i].uri);
}

// ---- accessors ----

void check_accessors(const Model& model, Findings& findings) {
    for (std::size_t i = 0; i < model.accessors.size(); ++i) {
        const std::string fault = gltf::accessor_fault(model, static_cast<int>(i));
        if (!fault.empty())
            findings.error(named("accessor", i), fault);
    }
}

std::optional<ElementReader> reader_of(const Model& model, int index) {
    if (!gltf::accessor_fault(model, index).empty())
        return std::nullopt;  // reported already, or by who names it
    return ElementReader(model, index);
}

void check_finite(const ElementReader& elements, const std::string& where, const std::string& what,
                  Findings& findings) {
    if (!findings.afford(elements.count()))
        return;
    for (std::size_t i = 0; i < elements.count(); ++i)
        for (int c = 0; c < elements.components(); ++c)
            if (!std::isfinite(elements.at(i, c))) {
                findings.error(where, "has ", what, " ", i, " that is no number");
                return;
            }
}

void check_unit_length(const ElementReader& elements, const std::string& where,
                       const std::string& what, double tolerance, Findings& findings) {
    if (!findings.afford(elements.count()))
        return;
    for (std::size_t i = 0; i < elements.count(); ++i) {
        double squares = 0.0;
        for (int c = 0; c < elements.components(); ++c)
            squares += elements.at(i, c) * elements.at(i, c);
        const double length = std::sqrt(squares);
        if (!(std::abs(length - 1.0) <= tolerance)) {
            findings.error(where, "has ", what, " ", i, " of length ", length, ", not 1");
            return;
        }
    }
}

// What rounding may do to a unit vector of that component type.
double unit_tolerance(const Model& model, int accessor) {
    switch (model.accessors[static_cast<std::size_t>(accessor)].componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 0.02;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 1e-3;
        default:
            return 5e-4;
    }
}

// ---- meshes ----

void check_bounds(const Model& model, int index, const ElementReader& positions,
                  const std::string& where, Findings& findings) {
    const auto& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (accessor.minValues.size() != 3 || accessor.maxValues.size() != 3) {
        findings.error(where, "has a POSITION without min and max");
        return;
    }
    if (!findings.afford(positions.count()))
        return;
    for (int c = 0; c < 3; ++c) {
        double low = positions.stored(0, c);
        double high = low;
        for (std::size_t i = 1; i < positions.count(); ++i) {
            low = std::min(low, positions.stored(i, c));
            high = std::max(high, positions.stored(i, c));
        }
        const auto k = static_cast<std::size_t>(c);
        const double slack = 1e-6 * std::max({1e-30, std::abs(low), std::abs(high)});
        if (std::abs(low - accessor.minValues[k]) > slack ||
            std::abs(high - accessor.maxValues[k]) > slack) {
            findings.error(where, "has POSITION bounds that are not those of its vertices");
            return;
        }
    }
}

void check_attributes(const Model& model, const tinygltf::Primitive& primitive,
                      std::size_t n_vertices, const std::string& where, Findings& findings) {
    for (const auto& [name, index] : primitive.attributes) {
        const auto elements = reader_of(model, index);
        if (!elements) {
            findings.error(where, "has a ", name, " whose accessor cannot be read");
            continue;
        }
        if (elements->count() != n_vertices)
            findings.error(where, "has ", elements->count(), " ", name, " for ", n_vertices,
                           " vertices");
        check_finite(*elements, where, name, findings);
        if (name == "NORMAL")
            check_unit_length(*elements, where, name, unit_tolerance(model, index), findings);
    }
}

void check_indices(const Model& model, int index, std::size_t n_vertices, const std::string& where,
                   Findings& findings) {
    const auto indices = reader_of(model, index);
    if (!indices || indices->components() != 1) {
        findings.error(where, "has indices that cannot be read");
        return;
    }
    if (!findings.afford(indices->count()))
        return;
    for (std::size_t i = 0; i < indices->count(); ++i) {
        const double v = indices->stored(i, 0);
        if (!(v >= 0.0 && v < static_cast<double>(n_vertices))) {
            findings.error(where, "names vertex ", v, ", it has ", n_vertices);
            return;
        }
    }
}

void check_primitive(const Model& model, const tinygltf::Primitive& primitive,
                     const std::string& where, Findings& findings) {
    check_declared(model, primitive.extensions, where, findings);
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        findings.error(where, "has no POSITION");
        return;
    }
    const auto positions = reader_of(model, position->second);
    const std::size_t n_vertices = positions ? positions->count() : 0;
    check_attributes(model, primitive, n_vertices, where, findings);
    if (positions && positions->components() == 3)
        check_bounds(model, position->second, *positions, where, findings);
    else if (positions)
        findings.error(where, "has a POSITION that is no VEC3");
    if (primitive.indices >= 0)
        check_indices(model, primitive.indices, n_vertices, where, findings);
}

// ---- nodes ----

struct AttributeRule {
    const char* name;
    int accessor;
    int type;
    const char* type_name;
    bool short_forms;  // normalised 8 and 16 bits are allowed besides float
};

bool component_allowed(const tinygltf::Accessor& accessor, bool short_forms) {
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
        return true;
    return short_forms && accessor.normalized &&
           (accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
            accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT);
}

std::optional<std::size_t> check_instance_attribute(const Model& model, const AttributeRule& rule,
                                                    const std::string& where, Findings& findings) {
    const std::string fault = gltf::accessor_fault(model, rule.accessor);
    if (!fault.empty()) {
        findings.error(where, "has instances whose ", rule.name, " accessor ", rule.accessor, " ",
                       fault);
        return std::nullopt;
    }
    const auto& accessor = model.accessors[static_cast<std::size_t>(rule.accessor)];
    if (accessor.type != rule.type) {
        findings.error(where, "has instances whose ", rule.name, " is no ", rule.type_name);
        return std::nullopt;
    }
    if (!component_allowed(accessor, rule.short_forms))
        findings.error(
            where, "has instances whose ", rule.name,
            rule.short_forms ? " is neither float nor normalised byte or short" : " is not float");
    const ElementReader elements(model, rule.accessor);
    check_finite(elements, where, std::string("an instance's ") + rule.name, findings);
    if (rule.type == TINYGLTF_TYPE_VEC4)
        check_unit_length(elements, where, std::string("an instance's ") + rule.name,
                          unit_tolerance(model, rule.accessor), findings);
    return elements.count();
}

void check_instancing(const Model& model, const tinygltf::Node& node, const std::string& where,
                      Findings& findings) {
    if (node.mesh < 0)
        findings.error(where, "has instances but no mesh");
    const gltf::InstanceAccessors accessors = gltf::instance_accessors(node);
    if (!accessors.fault.empty()) {
        findings.error(where, "has instancing that ", accessors.fault);
        return;
    }
    for (const std::string& name : accessors.others)
        if (name.empty() || name[0] != '_')
            findings.error(where, "has an instance attribute ", name,
                           "; names of its own start with an underscore");
    const AttributeRule rules[] = {
        {"TRANSLATION", accessors.translation, TINYGLTF_TYPE_VEC3, "VEC3", false},
        {"ROTATION", accessors.rotation, TINYGLTF_TYPE_VEC4, "VEC4", true},
        {"SCALE", accessors.scale, TINYGLTF_TYPE_VEC3, "VEC3", false}};
    std::map<std::string, std::size_t> counts;
    for (const AttributeRule& rule : rules)
        if (rule.accessor >= 0)
            if (const auto count = check_instance_attribute(model, rule, where, findings))
                counts[rule.name] = *count;
    for (const auto& [name, count] : counts)
        if (count != counts.begin()->second) {
            findings.error(where, "has ", counts.begin()->second, " ", counts.begin()->first,
                           " but ", count, " ", name, " of its instances");
            return;
        }
}

void check_node(const Model& model, std::size_t index, Findings& findings) {
    const tinygltf::Node& node = model.nodes[index];
    const std::string where = named("node", index);
    if (node.mesh >= static_cast<int>(model.meshes.size()))
        findings.error(where, "names mesh ", node.mesh, ", the file has ", model.meshes.size());
    const auto& r = node.rotation;
    if (r.size() == 4 &&
        !(std::abs(std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]) - 1.0) <= 5e-4))
        findings.error(where, "has a rotation that is not of unit length");
    if (node.extensions.contains(gltf::kInstancing))
        check_instancing(model, node, where, findings);
}

void check_model(const Model& model, Findings& findings) {
    check_extensions(model, findings);
    check_files(model, findings);
    check_accessors(model, findings);
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p)
            check_primitive(model, model.meshes[m].primitives[p],
                            named("mesh", m) + " " + named("primitive", p), findings);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        check_node(model, i, findings);
    if (model.scenes.empty())
        findings.warning("", "has no scene, viewers show nothing");
    const gltf::NodeOrder order = gltf::node_order(model);
    if (!order.fault.empty())
        findings.error("", "has no tree of nodes: ", order.fault);
}

}  // namespace

std::vector<GltfFinding> check_glb(std::span<const std::uint8_t> bytes, const GltfLimits& limits) {
    Findings findings;
    try {
        check_model(gltf::parse_glb(bytes, limits), findings);
    } catch (const InvalidInput& error) {
        findings.error("", error.what());
    }
    return findings.take();
}

std::vector<GltfFinding> check_glb_file(const std::filesystem::path& path,
                                        const GltfLimits& limits) {
    const std::string bytes = read_whole_file(path, limits.max_bytes);
    return check_glb({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, limits);
}

}  // namespace scree::meshing
