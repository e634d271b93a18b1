#include "terrain/json/json_values.h"

#include "base/error.h"

#include <algorithm>

namespace scree::terrain {

using nlohmann::json;

glm::dvec2 pair_of(const json& value, const JsonPlace& place) {
    list_of(value, place, 2);
    if (value.size() != 2)
        fail<InvalidInput>(place.text(), " must have 2 entries, has ", value.size());
    return {number_of(value[0], place.entry(0), -1e9, 1e9),
            number_of(value[1], place.entry(1), -1e9, 1e9)};
}

glm::dvec3 triple_of(const json& value, const JsonPlace& place) {
    list_of(value, place, 3);
    if (value.size() != 3)
        fail<InvalidInput>(place.text(), " must have 3 entries, has ", value.size());
    return {number_of(value[0], place.entry(0), -1e9, 1e9),
            number_of(value[1], place.entry(1), -1e9, 1e9),
            number_of(value[2], place.entry(2), -1e9, 1e9)};
}

double whole_of(const json& value, const JsonPlace& place, double low, double high) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (!value.is_number_integer())
        refuse_kind(place, value, "a whole number");
    return number_of(value, place, std::max(low, -kExact), std::min(high, kExact));
}

std::size_t word_of(const json& value, const JsonPlace& place,
                    std::span<const std::string_view> names) {
    const std::string word = text_of(value, place);
    std::string known;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == word)
            return i;
        known += (i > 0 ? ", " : "") + std::string(names[i]);
    }
    fail<InvalidInput>(place.text(), " is ", quoted(word.substr(0, 64)), ", must be one of ",
                       known);
}

}  // namespace scree::terrain
