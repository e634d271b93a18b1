#include "terrain/surface/json_object.h"

#include "base/error.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace scree::terrain {
namespace {

constexpr std::size_t kLongestList = 10000;
constexpr std::size_t kLongestKey = 64;
constexpr double kLargestNumber = 1e18;

}  // namespace

JsonObject::JsonObject(const Json& value, std::string source, std::string path)
    : value_(value), source_(std::move(source)), path_(std::move(path)) {
    if (!value.is_object())
        refuse("", "must be an object");
}

JsonObject JsonObject::object(const std::string& key) {
    return {required(key), source_, path_ + "/" + key};
}

std::vector<JsonObject> JsonObject::objects(const std::string& key) {
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

std::string JsonObject::text(const std::string& key) {
    const Json& value = required(key);
    if (!value.is_string())
        refuse(key, "must be a text");
    return value.get<std::string>();
}

double JsonObject::number(const std::string& key) {
    return number_of(required(key), key);
}

void JsonObject::number(const std::string& key, double& value) {
    if (has(key))
        value = number(key);
}

glm::vec3 JsonObject::vector(const std::string& key) {
    return vector_of(required(key), key);
}

void JsonObject::vector(const std::string& key, glm::vec3& value) {
    if (has(key))
        value = vector(key);
}

std::vector<glm::vec3> JsonObject::vectors(const std::string& key) {
    const Json& list = required(key);
    if (!list.is_array() || list.size() > kLongestList)
        refuse(key, "must be a list of at most " + std::to_string(kLongestList) + " places");
    std::vector<glm::vec3> all;
    for (std::size_t i = 0; i < list.size(); ++i)
        all.push_back(vector_of(list[i], key + "/" + std::to_string(i)));
    return all;
}

void JsonObject::finish() const {
    for (const auto& [key, value] : value_.items())
        if (!seen_.contains(key))
            refuse(key.substr(0, kLongestKey), "is not known here");
}

void JsonObject::refuse(const std::string& key, const std::string& what) const {
    const std::string place = path_ + (key.empty() ? "" : "/" + key);
    fail<InvalidInput>(source_, ": ", place.empty() ? "the whole" : place, " ", what);
}

const JsonObject::Json& JsonObject::required(const std::string& key) {
    if (!has(key))
        refuse(key, "is missing");
    seen_.insert(key);
    return value_[key];
}

double JsonObject::number_of(const Json& value, const std::string& key) const {
    if (!value.is_number())
        refuse(key, "must be a number");
    const double number = value.get<double>();
    if (!std::isfinite(number) || std::abs(number) > kLargestNumber)
        refuse(key, "is too large");
    return number;
}

glm::vec3 JsonObject::vector_of(const Json& value, const std::string& key) const {
    if (!value.is_array() || value.size() != 3)
        refuse(key, "must be a list of three numbers");
    glm::vec3 v(0.0F);
    for (int c = 0; c < 3; ++c)
        v[c] = static_cast<float>(
            number_of(value[static_cast<std::size_t>(c)], key + "/" + std::to_string(c)));
    return v;
}

bool JsonObject::flag_of(const Json& value, const std::string& key) const {
    if (!value.is_boolean())
        refuse(key, "must be true or false");
    return value.get<bool>();
}

double JsonObject::number_within(const Json& value, const std::string& key, const FieldInfo& info,
                                 bool whole) const {
    const double number = number_of(value, key);
    if (!(number >= info.min && number <= info.max)) {
        std::ostringstream what;
        what << "is " << number << ", must be in [" << info.min << ", " << info.max << "]"
             << (info.unit.empty() ? "" : " ") << info.unit;
        refuse(key, what.str());
    }
    if (whole && number != std::floor(number))
        refuse(key, "must be a whole number");
    return number;
}

std::size_t JsonObject::word_of(const Json& value, const std::string& key,
                                std::span<const std::string_view> words) const {
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (value.is_string() && value.get_ref<const std::string&>() == words[i])
            return i;
        all += (i == 0 ? "" : ", ") + std::string(words[i]);
    }
    refuse(key, "must be one of " + all);
}

}  // namespace scree::terrain
