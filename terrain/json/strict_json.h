#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

// For .cpp files alone, not installed: JSON whose every member is known, typed and in range.
namespace scree::terrain {

/// Parse text, refusing members given twice and nesting deeper than 16.
/// @throw InvalidInput  names `source` and the line.
nlohmann::json parse_strict(std::string_view text, const std::string& source);

/// The same for a file with one long list at its top: each entry of `list`, which must be an object
/// of at most `largest` values and members, is handed to `take` as it ends and then forgotten, so
/// that memory stays small. The list comes back empty.
struct StreamedList {
    std::string_view list;
    std::size_t largest = 0;
    std::function<void(const nlohmann::json& entry, std::size_t index)> take;
};
nlohmann::json parse_strict(std::string_view text, const std::string& source,
                            const StreamedList& streamed);

/// Where a value stands: file and path, such as `materials.json: materials[2].mobility`.
struct JsonPlace {
    std::string source;
    std::string path;

    JsonPlace member(std::string_view name) const;
    JsonPlace entry(std::size_t index) const;
    std::string text() const { return source + ": " + (path.empty() ? "the file" : path); }
};

/// One value of the wrong kind.
[[noreturn]] void refuse_kind(const JsonPlace& place, const nlohmann::json& value,
                              std::string_view wanted);

/// A number in [low, high]. @throw InvalidInput
double number_of(const nlohmann::json& value, const JsonPlace& place, double low, double high);
/// A whole number in [low, high].
int integer_of(const nlohmann::json& value, const JsonPlace& place, int low, int high);
/// Text of at most 1024 bytes without control characters.
std::string text_of(const nlohmann::json& value, const JsonPlace& place);
/// A list of at most `most` entries.
const nlohmann::json& list_of(const nlohmann::json& value, const JsonPlace& place,
                              std::size_t most);

/// An object whose members are asked for one by one; finish() refuses those nobody asked for.
class JsonObject {
public:
    /// @throw InvalidInput  the value is no object.
    JsonObject(const nlohmann::json& value, JsonPlace place);

    /// The member, or null.
    const nlohmann::json* find(std::string_view name);
    /// The member. @throw InvalidInput  it is missing.
    const nlohmann::json& get(std::string_view name);

    double number(std::string_view name, double otherwise, double low, double high);
    bool flag(std::string_view name, bool otherwise);
    std::string text(std::string_view name, const std::string& otherwise);

    /// @throw InvalidInput  a member was never asked for.
    void finish() const;
    JsonPlace at(std::string_view name) const { return place_.member(name); }
    const JsonPlace& place() const { return place_; }

private:
    const nlohmann::json& value_;
    JsonPlace place_;
    std::set<std::string, std::less<>> asked_;
};

/// Check the members `format` and `version` (1) that open every file of ours.
void check_format(JsonObject& object, std::string_view format);

/// Text as JSON, with bytes that are no UTF-8 replaced.
std::string quoted(const std::string& text);

}  // namespace scree::terrain
