#include "terrain/json/strict_json.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {

using nlohmann::json;

namespace {

constexpr int kDeepest = 16;
constexpr std::size_t kLongestText = 1024;
constexpr std::size_t kLongestReason = 160;  // the parser quotes what it read last, however long

std::string line_of(std::string_view text, std::size_t byte) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
    return "line " + std::to_string(1 + std::count(text.begin(), end, '\n'));
}

std::string shortened(const std::string& text) {
    return text.size() <= 64 ? text : text.substr(0, 61) + "...";
}

// Follows the parser: it keeps the last of two members of one name, silently.
class Watcher {
public:
    Watcher(const std::string& source, const StreamedList& streamed)
        : source_(source), streamed_(streamed) {}

    /// False if what just ended need not be kept.
    bool operator()(int depth, json::parse_event_t event, json& parsed) {
        if (depth > kDeepest)
            fail<InvalidInput>(source_, " nests deeper than ", kDeepest, " levels");
        if (event == json::parse_event_t::object_start)
            seen_.emplace_back();
        if (event == json::parse_event_t::object_end)
            seen_.pop_back();
        if (event == json::parse_event_t::key)
            note(depth, parsed.get_ref<const std::string&>());
        return streamed_.list.empty() || member_ != streamed_.list || stream(depth, event, parsed);
    }

private:
    void note(int depth, const std::string& name) {
        if (!seen_.back().insert(name).second)
            fail<InvalidInput>(source_, " gives the member ", quoted(shortened(name)),
                               " twice in one object");
        if (depth == 1)
            member_ = name;
    }

    // The list is the value of a member of the root, so its entries stand at depth 2.
    bool stream(int depth, json::parse_event_t event, json& parsed) {
        using Event = json::parse_event_t;
        const JsonPlace place{source_,
                              std::string(streamed_.list) + "[" + std::to_string(index_) + "]"};
        const bool entry = depth == 2 && (event == Event::value || event == Event::array_start);
        if (entry)
            fail<InvalidInput>(place.text(), " must be an object");
        if (++n_values_ > streamed_.largest)
            fail<InvalidInput>(place.text(), " holds more than ", streamed_.largest, " values");
        if (depth != 2 || event != Event::object_end)
            return true;
        streamed_.take(parsed, index_++);
        n_values_ = 0;
        return false;
    }

    const std::string& source_;
    const StreamedList& streamed_;
    std::vector<std::set<std::string>> seen_;
    std::string member_;  // of the root, that is being read
    std::size_t index_ = 0;
    std::size_t n_values_ = 0;
};

}  // namespace

std::string quoted(const std::string& text) {
    return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

json parse_strict(std::string_view text, const std::string& source) {
    return parse_strict(text, source, StreamedList{});
}

json parse_strict(std::string_view text, const std::string& source, const StreamedList& streamed) {
    Watcher watcher(source, streamed);
    try {
        return json::parse(text, [&](int depth, json::parse_event_t event, json& parsed) {
            return watcher(depth, event, parsed);
        });
    } catch (const json::parse_error& error) {
        const std::string_view reason = error.what();
        const auto start = reason.find("] ");
        fail<InvalidInput>(
            source, " is no JSON at ", line_of(text, error.byte), ": ",
            reason.substr(start == std::string_view::npos ? 0 : start + 2, kLongestReason));
    } catch (const json::exception& error) {  // a number beyond a double
        fail<InvalidInput>(
            source, " is no JSON: ", std::string_view(error.what()).substr(0, kLongestReason));
    }
}

JsonPlace JsonPlace::member(std::string_view name) const {
    return {source, path.empty() ? std::string(name) : path + "." + std::string(name)};
}

JsonPlace JsonPlace::entry(std::size_t index) const {
    return {source, path + "[" + std::to_string(index) + "]"};
}

void refuse_kind(const JsonPlace& place, const json& value, std::string_view wanted) {
    fail<InvalidInput>(place.text(), " is of type ", value.type_name(), ", must be ", wanted);
}

double number_of(const json& value, const JsonPlace& place, double low, double high) {
    if (!value.is_number())
        refuse_kind(place, value, "a number");
    const double number = value.get<double>();
    if (!(number >= low && number <= high))
        fail<InvalidInput>(place.text(), " is ", number, ", must be in [", low, ", ", high, "]");
    return number;
}

int integer_of(const json& value, const JsonPlace& place, int low, int high) {
    if (!value.is_number_integer())
        refuse_kind(place, value, "a whole number");
    return static_cast<int>(number_of(value, place, low, high));
}

std::string text_of(const json& value, const JsonPlace& place) {
    if (!value.is_string())
        refuse_kind(place, value, "a string");
    const auto& text = value.get_ref<const std::string&>();
    const bool plain = std::none_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    });
    if (text.size() > kLongestText || !plain)
        fail<InvalidInput>(place.text(), " must be at most ", kLongestText,
                           " bytes without control characters");
    return text;
}

const json& list_of(const json& value, const JsonPlace& place, std::size_t most) {
    if (!value.is_array())
        refuse_kind(place, value, "a list");
    if (value.size() > most)
        fail<InvalidInput>(place.text(), " has ", value.size(), " entries, at most ", most,
                           " are allowed");
    return value;
}

JsonObject::JsonObject(const json& value, JsonPlace place)
    : value_(value), place_(std::move(place)) {
    if (!value.is_object())
        refuse_kind(place_, value, "an object");
}

const json* JsonObject::find(std::string_view name) {
    asked_.emplace(name);
    const auto found = value_.find(std::string(name));
    return found == value_.end() ? nullptr : &*found;
}

const json& JsonObject::get(std::string_view name) {
    const json* found = find(name);
    if (found == nullptr)
        fail<InvalidInput>(at(name).text(), " is missing");
    return *found;
}

double JsonObject::number(std::string_view name, double otherwise, double low, double high) {
    const json* found = find(name);
    return found == nullptr ? otherwise : number_of(*found, at(name), low, high);
}

bool JsonObject::flag(std::string_view name, bool otherwise) {
    const json* found = find(name);
    if (found != nullptr && !found->is_boolean())
        refuse_kind(at(name), *found, "true or false");
    return found == nullptr ? otherwise : found->get<bool>();
}

std::string JsonObject::text(std::string_view name, const std::string& otherwise) {
    const json* found = find(name);
    return found == nullptr ? otherwise : text_of(*found, at(name));
}

void JsonObject::finish() const {
    for (const auto& member : value_.items()) {
        if (asked_.find(member.key()) != asked_.end())
            continue;
        std::string known;
        for (const std::string& name : asked_)
            known += (known.empty() ? "" : ", ") + name;
        fail<InvalidInput>(place_.text(), " has the unknown member ",
                           quoted(shortened(member.key())), "; known are ", known);
    }
}

void check_format(JsonObject& object, std::string_view format) {
    const std::string given = text_of(object.get("format"), object.at("format"));
    if (given != format)
        fail<InvalidInput>(object.at("format").text(), " is ", quoted(shortened(given)),
                           ", must be \"", format, "\"");
    integer_of(object.get("version"), object.at("version"), 1, 1);
}

}  // namespace scree::terrain
