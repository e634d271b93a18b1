#pragma once

// Inside readers of JSON alone; not installed.

#include "base/error.h"
#include "base/options.h"

#include <cmath>
#include <set>
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

    JsonObject(const Json& value, std::string source, std::string path)
        : value_(value), source_(std::move(source)), path_(std::move(path)) {
        if (!value.is_object())
            refuse("", "must be an object");
    }

    bool has(const std::string& key) const { return value_.contains(key); }

    /// The object in a member; must be there.
    JsonObject object(const std::string& key) {
        return {required(key), source_, path_ + "/" + key};
    }
    /// The objects of a list; an absent member is an empty list.
    std::vector<JsonObject> objects(const std::string& key) {
        std::vector<JsonObject> all;
        if (!has(key))
            return all;
        const Json& list = required(key);
        if (!list.is_array())
            refuse(key, "must be a list of objects");
        if (list.size() > kLongestList)
            refuse(key, "has more than " + std::to_string(kLongestList) + " entries");
        for (std::size_t i = 0; i < list.size(); ++i)
            all.emplace_back(list[i], source_, path_ + "/" + key + "/" + std::to_string(i));
        return all;
    }

    std::string text(const std::string& key) {
        const Json& value = required(key);
        if (!value.is_string())
            refuse(key, "must be a text");
        return value.get<std::string>();
    }
    double number(const std::string& key) { return number_of(required(key), key); }
    void number(const std::string& key, double& value) {
        if (has(key))
            value = number(key);
    }
    void vector(const std::string& key, glm::vec3& value) {
        if (has(key))
            value = vector_of(required(key), key);
    }
    glm::vec3 vector(const std::string& key) { return vector_of(required(key), key); }
    std::vector<glm::vec3> vectors(const std::string& key) {
        const Json& list = required(key);
        if (!list.is_array() || list.size() > kLongestList)
            refuse(key, "must be a list of at most " + std::to_string(kLongestList) + " places");
        std::vector<glm::vec3> all;
        for (std::size_t i = 0; i < list.size(); ++i)
            all.push_back(vector_of(list[i], key + "/" + std::to_string(i)));
        return all;
    }

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

    void finish() const {
        for (const auto& [key, value] : value_.items())
            if (!seen_.contains(key))
                refuse(key.substr(0, kLongestKey), "is not known here");
    }

    [[noreturn]] void refuse(const std::string& key, const std::string& what) const {
        std::string place = path_ + (key.empty() ? "" : "/" + key);
        fail<InvalidInput>(source_, ": ", place.empty() ? "the whole" : place, " ", what);
    }

private:
    static constexpr std::size_t kLongestList = 10000;
    static constexpr std::size_t kLongestKey = 64;

    const Json& required(const std::string& key) {
        if (!has(key))
            refuse(key, "is missing");
        seen_.insert(key);
        return value_[key];
    }
    double number_of(const Json& value, const std::string& key) const {
        if (!value.is_number())
            refuse(key, "must be a number");
        const double number = value.get<double>();
        if (!std::isfinite(number) || std::abs(number) > 1e18)
            refuse(key, "is too large");
        return number;
    }
    glm::vec3 vector_of(const Json& value, const std::string& key) const {
        if (!value.is_array() || value.size() != 3)
            refuse(key, "must be a list of three numbers");
        glm::vec3 v(0.0F);
        for (int c = 0; c < 3; ++c)
            v[c] = static_cast<float>(
                number_of(value[static_cast<std::size_t>(c)], key + "/" + std::to_string(c)));
        return v;
    }

    template <class Value>
    void field(const std::string& key, Value& value, const FieldInfo& info) {
        const Json& json = required(key);
        if constexpr (std::is_enum_v<Value>) {
            word(key, json, value);
        } else if constexpr (std::is_same_v<Value, bool>) {
            if (!json.is_boolean())
                refuse(key, "must be true or false");
            value = json.get<bool>();
        } else {
            const double number = number_of(json, key);
            if (!(number >= info.min && number <= info.max)) {
                std::ostringstream what;
                what << "is " << number << ", must be in [" << info.min << ", " << info.max << "]"
                     << (info.unit.empty() ? "" : " ") << info.unit;
                refuse(key, what.str());
            }
            if (std::is_integral_v<Value> && number != std::floor(number))
                refuse(key, "must be a whole number");
            value = static_cast<Value>(number);
        }
    }
    template <class Enum>
    void word(const std::string& key, const Json& json, Enum& value) const {
        std::string all;
        const auto names = names_of(Enum{});
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (json.is_string() && json.get_ref<const std::string&>() == names[i]) {
                value = static_cast<Enum>(i);
                return;
            }
            all += (i == 0 ? "" : ", ") + std::string(names[i]);
        }
        refuse(key, "must be one of " + all);
    }

    const Json& value_;
    std::string source_;
    std::string path_;
    std::set<std::string> seen_;
};

}  // namespace scree::terrain
