#include "vision/data/rocks_json.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"
#include "vision/data/rocks_json_format.h"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

namespace scree::vision {
namespace {

using nlohmann::json;
using rocks_file::kFormat;
using rocks_file::kLikenessVersion;
using rocks_file::kPlainVersion;

constexpr std::size_t kLongestReason = 160;  // the parser quotes what it read last, however long

enum class Place { Outside, Set, Rocks, Rock, Centre, Radii };
enum class Kind { Text, Number, Flag, Null };

struct Value {
    Kind kind = Kind::Null;
    std::string_view text;  // of a string, or of a number as it stands in the file
    double number = 0.0;
    bool flag = false;
};

enum SetMember : unsigned {
    kImage = 1,
    kWidth = 2,
    kHeight = 4,
    kScale = 8,
    kMethod = 16,
    kRocks = 32,
    kName = 64,
    kNumber = 128,
    kLikeness = 256
};
enum RockMember : unsigned {
    kCentre = 1,
    kRadiiList = 2,
    kDepth = 4,
    kConfidence = 8,
    kUncertainty = 16,
    kBorder = 32,
    kWholeRock = 63
};

struct MemberName {
    std::string_view name;
    unsigned bit;
};

constexpr MemberName kSetMembers[] = {
    {"format", kName},   {"version", kNumber}, {"image", kImage},
    {"width", kWidth},   {"height", kHeight},  {"metres_per_pixel", kScale},
    {"method", kMethod}, {"rocks", kRocks},    {"likeness", kLikeness}};
constexpr MemberName kRockMembers[] = {
    {"centre", kCentre},         {"radii", kRadiiList},         {"depth", kDepth},
    {"confidence", kConfidence}, {"uncertainty", kUncertainty}, {"touches_border", kBorder}};

/// Fills a RockSet while the text is parsed: nothing is kept that the format does not know, so
/// memory and depth are bounded by the rocks themselves.
class Reader {
public:
    Reader(const std::string& source, const RocksFileLimits& limits)
        : source_(source), limits_(limits) {}

    RockSet take() {
        if (place_ != Place::Outside || seen_set_ == 0)
            refuse("holds no object");
        check_rock_set(set_, source_, limits_);
        return std::move(set_);
    }

    // The calls of nlohmann's SAX interface.
    bool null() { return value({}); }
    bool boolean(bool flag) { return value({Kind::Flag, {}, 0.0, flag}); }
    bool number_integer(json::number_integer_t n) {
        return value({Kind::Number, {}, static_cast<double>(n), false});
    }
    bool number_unsigned(json::number_unsigned_t n) {
        return value({Kind::Number, {}, static_cast<double>(n), false});
    }
    bool number_float(json::number_float_t n, const std::string& text) {
        const double exact = parse_number<double>(text).value_or(n);
        return value({Kind::Number, text, exact, false});
    }
    bool string(const std::string& text) { return value({Kind::Text, text, 0.0, false}); }
    bool binary(const json::binary_t&) { refuse("is binary"); }

    bool start_object(std::size_t) {
        if (place_ == Place::Outside && seen_set_ == 0) {
            place_ = Place::Set;
        } else if (place_ == Place::Rocks) {
            if (set_.rocks.size() >= kMaxRocks)
                refuse("holds more than 65535 rocks");
            set_.rocks.emplace_back();
            seen_rock_ = 0;
            place_ = Place::Rock;
        } else {
            refuse("is an object and should not be");
        }
        key_.clear();
        return true;
    }

    bool end_object() {
        key_.clear();
        if (place_ == Place::Rock) {
            require_all(seen_rock_, kRockMembers);
            place_ = Place::Rocks;
        } else {
            require_set();
            place_ = Place::Outside;
        }
        return true;
    }

    bool start_array(std::size_t) {
        if (place_ == Place::Set && key_ == "rocks")
            place_ = Place::Rocks;
        else if (place_ == Place::Rock && key_ == "centre")
            place_ = Place::Centre;
        else if (place_ == Place::Rock && key_ == "radii")
            place_ = Place::Radii;
        else
            refuse("is a list and should not be");
        n_entries_ = 0;
        return true;
    }

    bool end_array() {
        if (place_ == Place::Rocks) {
            place_ = Place::Set;
            return true;
        }
        const std::size_t wanted = place_ == Place::Centre ? 2 : kRadii;
        place_ = Place::Rock;
        if (n_entries_ != wanted)
            refuse("has ", n_entries_, " numbers, must have ", wanted);
        return true;
    }

    bool key(const std::string& name) {
        key_ = name.substr(0, 64);
        if (place_ == Place::Set)
            note(seen_set_, kSetMembers);
        else
            note(seen_rock_, kRockMembers);
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const json::exception& error) {
        const std::string_view reason = error.what();
        const auto start = reason.find("] ");
        fail<InvalidInput>(
            source_, " is no JSON at byte ", position, ": ",
            reason.substr(start == std::string_view::npos ? 0 : start + 2, kLongestReason));
    }

private:
    std::string path() const {
        if (place_ == Place::Outside)
            return "the text";
        if (place_ == Place::Set)
            return key_.empty() ? "the object" : key_;
        if (place_ == Place::Rocks)
            return "rocks[" + std::to_string(set_.rocks.size()) + "]";
        std::string text = "rocks[" + std::to_string(set_.rocks.size() - 1) + "]";
        if (!key_.empty())
            text += "." + key_;
        if (place_ != Place::Rock)
            text += "[" + std::to_string(n_entries_) + "]";
        return text;
    }

    template <class... Parts>
    [[noreturn]] void refuse(const Parts&... parts) const {
        fail<InvalidInput>(source_, ": ", path(), " ", parts...);
    }

    template <std::size_t N>
    void note(unsigned& seen, const MemberName (&members)[N]) {
        for (const MemberName& member : members)
            if (member.name == key_) {
                if ((seen & member.bit) != 0)
                    refuse("is given twice");
                seen |= member.bit;
                return;
            }
        refuse("is no member of format ", kFormat, " version ", version_);
    }

    template <std::size_t N>
    void require_all(unsigned seen, const MemberName (&members)[N]) const {
        for (const MemberName& member : members)
            if ((seen & member.bit) == 0)
                refuse("has no member '", member.name, "'");
    }

    // Only version 2 has the likeness, and has it always.
    void require_set() const {
        const bool has_likeness = (seen_set_ & kLikeness) != 0;
        require_all(version_ == kPlainVersion ? seen_set_ | kLikeness : seen_set_, kSetMembers);
        if (version_ == kPlainVersion && has_likeness)
            fail<InvalidInput>(source_, ": likeness is no member of format ", kFormat, " version ",
                               kPlainVersion);
    }

    double number(const Value& value) const {
        if (value.kind != Kind::Number)
            refuse("must be a number");
        return value.number;
    }

    // From the digits themselves: by way of double the last bit could come out wrong.
    float small_number(const Value& value) const {
        const double wide = number(value);
        const auto direct = parse_number<float>(value.text);
        if (!direct && !(std::abs(wide) <= kMaxCoordinate))
            refuse("is ", wide, ", must be at most 1e6");
        return direct.value_or(static_cast<float>(wide));
    }

    int whole_number(const Value& value) const {
        const double n = number(value);
        if (!(n >= 0 && n <= std::numeric_limits<int>::max()) || n != std::floor(n))
            refuse("is ", n, ", must be a whole number");
        return static_cast<int>(n);
    }

    std::string words(const Value& value) const {
        if (value.kind != Kind::Text)
            refuse("must be a text");
        if (value.text.size() > kMaxNameLength)
            refuse("has ", value.text.size(), " bytes, at most ", kMaxNameLength, " are allowed");
        return std::string(value.text);
    }

    bool value(const Value& value) {
        switch (place_) {
            case Place::Set:
                set_value(value);
                return true;
            case Place::Rock:
                rock_value(set_.rocks.back(), value);
                return true;
            case Place::Centre:
                if (n_entries_ < 2)
                    (n_entries_ == 0 ? outline().centre.x : outline().centre.y) = number(value);
                ++n_entries_;
                return true;
            case Place::Radii:
                if (n_entries_ < kRadii)
                    outline().radii[n_entries_] = small_number(value);
                ++n_entries_;
                return true;
            case Place::Outside:
            case Place::Rocks:
                break;
        }
        refuse("must be an object");
    }

    Outline& outline() { return set_.rocks.back().outline; }

    void set_value(const Value& value) {
        if (key_ == "format") {
            if (words(value) != kFormat)
                refuse("is '", value.text, "', must be '", kFormat, "'");
        } else if (key_ == "version") {
            version_ = value.number == kPlainVersion ? kPlainVersion : kLikenessVersion;
            if (number(value) != version_)
                refuse("is ", value.number, ", this program reads versions ", kPlainVersion,
                       " and ", kLikenessVersion);
        } else if (key_ == "image") {
            set_.image = words(value);
        } else if (key_ == "method") {
            set_.method = words(value);
        } else if (key_ == "width") {
            set_.width = whole_number(value);
        } else if (key_ == "height") {
            set_.height = whole_number(value);
        } else if (key_ == "metres_per_pixel") {
            if (value.kind != Kind::Null && !((set_.metres_per_pixel = number(value)) > 0.0))
                refuse("is ", value.number, ", must be above 0, or null if unknown");
        } else if (key_ == "likeness") {
            set_.likeness = number(value);
            if (!(*set_.likeness >= 0.0 && *set_.likeness <= 1.0))
                refuse("is ", *set_.likeness, ", must be in [0, 1]");
        } else {
            refuse("must be a list");
        }
    }

    void rock_value(Rock& rock, const Value& value) {
        if (key_ == "depth") {
            rock.depth = small_number(value);
        } else if (key_ == "confidence") {
            rock.outline.confidence = small_number(value);
        } else if (key_ == "uncertainty") {
            rock.uncertainty = small_number(value);
        } else if (key_ == "touches_border") {
            if (value.kind != Kind::Flag)
                refuse("must be true or false");
            rock.outline.touches_border = value.flag;
        } else {
            refuse("must be a list");
        }
    }

    const std::string& source_;
    const RocksFileLimits& limits_;
    RockSet set_;
    Place place_ = Place::Outside;
    std::string key_;
    int version_ = kPlainVersion;
    unsigned seen_set_ = 0;
    unsigned seen_rock_ = 0;
    std::size_t n_entries_ = 0;
};

}  // namespace

RockSet rocks_from_json(std::string_view text, const std::string& source,
                        const RocksFileLimits& limits) {
    if (text.size() > limits.max_bytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", limits.max_bytes);
    Reader reader(source, limits);
    json::sax_parse(text, &reader);
    return reader.take();
}

RockSet read_rocks_json(const std::filesystem::path& path, const RocksFileLimits& limits) {
    return rocks_from_json(read_whole_file(path, limits.max_bytes), path.string(), limits);
}

}  // namespace scree::vision
