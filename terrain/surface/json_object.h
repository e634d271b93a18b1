#pragma once

// Inside readers of JSON alone; not installed.

#include "base/options.h"

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace scree::terrain {

/// One object of a JSON file, read member by member. Every complaint names the file and the place
/// (a JSON pointer); finish() complains of members that nobody asked for.
class JsonObject {
public:
    using Json = nlohmann::json;

    JsonObject(const Json& value, std::string source, std::string path);

    bool has(const std::string& key) const { return value_.contains(key); }

    /// The object in a member; must be there.
    JsonObject object(const std::string& key);
    /// The objects of a list; an absent member is an empty list.
    std::vector<JsonObject> objects(const std::string& key);

    std::string text(const std::string& key);
    double number(const std::string& key);
    glm::vec3 vector(const std::string& key);
    std::vector<glm::vec3> vectors(const std::string& key);
    /// The same for members that may be absent.
    void number(const std::string& key, double& value);
    void vector(const std::string& key, glm::vec3& value);

    /// Every field that describe() names, under its name with `_` for `-`; absent ones keep their
    /// values.
    template <class Options>
    void options(Options& options) {
        describe(options, [this](std::string_view name, auto& value, const FieldInfo& info) {
            std::string key(name);
            for (char& c : key)
                c = c == '-' ? '_' : c;
            if (has(key))
                field(key, value, info);
        });
    }

    void finish() const;

    [[noreturn]] void refuse(const std::string& key, const std::string& what) const;

private:
    const Json& required(const std::string& key);
    double number_of(const Json& value, const std::string& key) const;
    glm::vec3 vector_of(const Json& value, const std::string& key) const;
    bool flag_of(const Json& value, const std::string& key) const;
    double number_within(const Json& value, const std::string& key, const FieldInfo& info,
                         bool whole) const;
    std::size_t word_of(const Json& value, const std::string& key,
                        std::span<const std::string_view> words) const;

    template <class Value>
    void field(const std::string& key, Value& value, const FieldInfo& info) {
        const Json& json = required(key);
        if constexpr (std::is_enum_v<Value>)
            value = static_cast<Value>(word_of(json, key, names_of(Value{})));
        else if constexpr (std::is_same_v<Value, bool>)
            value = flag_of(json, key);
        else
            value = static_cast<Value>(number_within(json, key, info, std::is_integral_v<Value>));
    }

    const Json& value_;
    std::string source_;
    std::string path_;
    std::set<std::string> seen_;
};

}  // namespace scree::terrain
