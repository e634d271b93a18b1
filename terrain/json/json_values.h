#pragma once

#include "base/options.h"
#include "terrain/json/strict_json.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// For .cpp files alone, not installed: values of more than one number, and described options.
namespace scree::terrain {

glm::dvec2 pair_of(const nlohmann::json& value, const JsonPlace& place);
glm::dvec3 triple_of(const nlohmann::json& value, const JsonPlace& place);

/// A whole number in [low, high]; beyond 2^53 not every one can be told from its neighbours.
double whole_of(const nlohmann::json& value, const JsonPlace& place, double low, double high);

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
            value = static_cast<Value>(whole_of(*found, object.at(member), info.min, info.max));
        else
            value = number_of(*found, object.at(member), info.min, info.max);
    });
}

}  // namespace scree::terrain
