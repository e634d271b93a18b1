#include "base/number_text.h"
#include "base/whole_file.h"
#include "vision/data/rocks_json.h"
#include "vision/data/rocks_json_format.h"

#include <limits>

#include <nlohmann/json.hpp>

namespace scree::vision {
namespace {

using nlohmann::json;

std::string quoted(const std::string& text) {  // bytes that are no UTF-8 become U+FFFD
    return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

void append_rock(std::string& text, const Rock& rock) {
    text += R"({"centre":[)";
    append_number(text, rock.outline.centre.x);
    text += ',';
    append_number(text, rock.outline.centre.y);
    text += R"(],"depth":)";
    append_number(text, rock.depth);
    text += R"(,"confidence":)";
    append_number(text, rock.outline.confidence);
    text += R"(,"uncertainty":)";
    append_number(text, rock.uncertainty);
    text += R"(,"touches_border":)";
    text += rock.outline.touches_border ? "true" : "false";
    text += R"(,"radii":[)";
    for (std::size_t k = 0; k < kRadii; ++k) {
        if (k > 0)
            text += ',';
        append_number(text, rock.outline.radii[k]);
    }
    text += "]}";
}

}  // namespace

std::string rocks_to_json(const RockSet& set) {
    check_rock_set(set, "the rocks to write", {.max_pixels = std::numeric_limits<double>::max()});
    std::string text =
        "{\n\"format\":" + quoted(std::string(rocks_file::kFormat)) + ",\n\"version\":";
    text +=
        std::to_string(set.likeness ? rocks_file::kLikenessVersion : rocks_file::kPlainVersion) +
        ",\n\"image\":";
    text += quoted(set.image) + ",\n\"width\":" + std::to_string(set.width) +
            ",\n\"height\":" + std::to_string(set.height) + ",\n\"metres_per_pixel\":";
    if (set.metres_per_pixel > 0.0)
        append_number(text, set.metres_per_pixel);
    else
        text += "null";
    text += ",\n\"method\":" + quoted(set.method);
    if (set.likeness) {
        text += ",\n\"likeness\":";
        append_number(text, *set.likeness);
    }
    text += ",\n\"rocks\":[";
    text.reserve(text.size() + set.rocks.size() * 4096);
    for (std::size_t i = 0; i < set.rocks.size(); ++i) {
        text += i == 0 ? "\n" : ",\n";
        append_rock(text, set.rocks[i]);
    }
    text += "\n]\n}\n";
    return text;
}

void write_rocks_json(const std::filesystem::path& path, const RockSet& set) {
    write_staged_file(path, rocks_to_json(set));
}

}  // namespace scree::vision
