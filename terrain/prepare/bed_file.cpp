#include "base/error.h"
#include "terrain/json/json_values.h"
#include "terrain/prepare/river_bed.h"

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr std::size_t kMostBeds = 64;
constexpr std::size_t kMostPoints = 2000;

RiverBed bed_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    RiverBed bed;
    const json& line = list_of(object.get("line"), object.at("line"), kMostPoints);
    if (line.size() < 2)
        fail<InvalidInput>(object.at("line").text(), " must have at least 2 points");
    for (std::size_t i = 0; i < line.size(); ++i)
        bed.line.push_back(pair_of(line[i], object.at("line").entry(i)));
    read_options(object, bed.options);
    object.finish();
    return bed;
}

}  // namespace

std::vector<RiverBed> beds_from_json(std::string_view text, const std::string& source) {
    const json document = parse_strict(text, source);
    JsonObject object(document, {source, ""});
    check_format(object, "scree-beds");
    const json& list = list_of(object.get("beds"), object.at("beds"), kMostBeds);
    std::vector<RiverBed> beds;
    for (std::size_t i = 0; i < list.size(); ++i)
        beds.push_back(bed_from(list[i], object.at("beds").entry(i)));
    object.finish();
    return beds;
}

}  // namespace scree::terrain
