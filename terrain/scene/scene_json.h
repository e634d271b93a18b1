#pragma once

#include "base/options.h"
#include "terrain/material/strict_json.h"
#include "terrain/scene/scene.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// For the .cpp files of this folder: parts of a scene from JSON.
namespace scree::terrain {

glm::dvec2 pair_of(const nlohmann::json& value, const JsonPlace& place);
glm::dvec3 triple_of(const nlohmann::json& value, const JsonPlace& place);

/// Index of the word in `names`. @throw InvalidInput  lists them.
std::size_t word_of(const nlohmann::json& value, const JsonPlace& place,
                    std::span<const std::string_view> names);

/// Fill described options from the members of an object; a field `time-step` is the member
/// `time_step`.
template <class Options>
void read_options(JsonObject& object, Options& options) {
    describe(options, [&](std::string_view name, auto& value, const FieldInfo& info) {
        using Value = std::remove_cvref_t<decltype(value)>;
        std::string member(name);
        std::replace(member.begin(), member.end(), '-', '_');
        const nlohmann::json* found = object.find(member);
        if (found == nullptr)
            return;
        if constexpr (std::is_enum_v<Value>)
            value = static_cast<Value>(word_of(*found, object.at(member), names_of(Value{})));
        else if constexpr (std::is_same_v<Value, bool>)
            value = object.flag(member, value);
        else if constexpr (std::is_integral_v<Value>)
            value = static_cast<Value>(integer_of(
                *found, object.at(member), static_cast<int>(info.min), static_cast<int>(info.max)));
        else
            value = number_of(*found, object.at(member), info.min, info.max);
    });
}

/// The path of a file, resolved, and noted among the scene's files.
std::filesystem::path file_of(const nlohmann::json& value, const JsonPlace& place,
                              const std::filesystem::path& folder, Scene& scene);

GroundSpec ground_from(const nlohmann::json& value, const JsonPlace& place,
                       const std::filesystem::path& folder, Scene& scene);
MaterialRegion region_from(const nlohmann::json& value, const JsonPlace& place,
                           const std::vector<Material>& materials);
SceneObject object_from(const nlohmann::json& value, const JsonPlace& place,
                        const std::filesystem::path& folder, Scene& scene);
ObjectMotion motion_from(const nlohmann::json& value, const JsonPlace& place);

}  // namespace scree::terrain
