#include "base/error.h"
#include "base/whole_file.h"
#include "terrain/material/map_check.h"
#include "terrain/material/map_rules.h"
#include "terrain/json/strict_json.h"
#include "terrain/material/material_reference.h"

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{4} << 20;

RuleRange range_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    RuleRange range;
    range.low = object.number("min", range.low, -1e9, 1e9);
    range.high = object.number("max", range.high, -1e9, 1e9);
    range.soft = object.number("soft", 0.0, 0.0, 1e8);
    object.finish();
    if (range.low > range.high)
        fail<InvalidInput>(place.text(), " has min ", range.low, " above max ", range.high);
    return range;
}

MapRule rule_from(const json& value, const JsonPlace& place,
                  const std::vector<Material>& materials) {
    JsonObject object(value, place);
    MapRule rule;
    rule.id = material_id(object.get("material"), object.at("material"), materials);
    for (std::size_t q = 0; q < kRuleQuantities; ++q)
        if (const json* range = object.find(kRuleQuantityNames[q]))
            rule.ranges[q] = range_from(*range, object.at(kRuleQuantityNames[q]));
    object.finish();
    return rule;
}

}  // namespace

RuleSet rules_from_json(std::string_view text, const std::string& source,
                        const std::vector<Material>& materials) {
    if (text.size() > kMaxBytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", kMaxBytes);
    const json root = parse_strict(text, source);
    JsonObject object(root, {source, ""});
    check_format(object, "scree-rules");
    RuleSet set;
    if (const json* level = object.find("water_level"))
        set.water_level = number_of(*level, object.at("water_level"), -1e9, 1e9);
    set.otherwise = material_id(object.get("otherwise"), object.at("otherwise"), materials);
    const JsonPlace place = object.at("rules");
    const json& list = list_of(object.get("rules"), place, kMaxRules);
    for (std::size_t i = 0; i < list.size(); ++i) {
        set.rules.push_back(rule_from(list[i], place.entry(i), materials));
        if (list[i].contains("water_distance") && !set.water_level)
            fail<InvalidInput>(place.entry(i).member("water_distance").text(),
                               " needs the member water_level of the file");
    }
    object.finish();
    return set;
}

RuleSet read_rules(const std::filesystem::path& path, const std::vector<Material>& materials) {
    return rules_from_json(read_whole_file(path, kMaxBytes), path.string(), materials);
}

}  // namespace scree::terrain
