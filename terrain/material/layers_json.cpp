#include "terrain/material/layers_json.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "terrain/json/strict_json.h"
#include "terrain/material/map_check.h"
#include "terrain/material/map_files.h"
#include "terrain/material/material_reference.h"
#include "terrain/material/materials_json.h"

#include <algorithm>

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr double kThinnest = 1e-6;  // metres
constexpr double kThickest = 1e6;

LayerSpec layer_from(const json& value, const JsonPlace& place,
                     const std::vector<Material>& materials, const std::filesystem::path& folder) {
    JsonObject object(value, place);
    LayerSpec layer;
    layer.thickness_m =
        number_of(object.get("thickness_m"), object.at("thickness_m"), kThinnest, kThickest);
    if (const json* material = object.find("material"))
        layer.material = material_id(*material, object.at("material"), materials);
    if (const std::string map = object.text("map", ""); !map.empty())
        layer.map = resolved_path(map, folder);
    if (layer.material && !layer.map.empty())
        fail<InvalidInput>(object.at("map").text(), " stands beside material, give one of them");
    object.finish();
    return layer;
}

// The layer's amounts by the ids of a map of its own.
void lay_map(const LayerSpec& spec, const DescriptionMap& above, std::size_t n,
             std::vector<Raster<double>>& amounts) {
    const DescriptionMap own = read_description_map(spec.map);
    if (own.ids.width() != above.ids.width() || own.ids.height() != above.ids.height())
        fail<InvalidInput>("the map of layer ", n, ", ", spec.map.string(), ", has ",
                           own.ids.width(), " x ", own.ids.height(), " cells, the uppermost ",
                           above.ids.width(), " x ", above.ids.height());
    const auto slots = slots_of_ids(above.materials);
    for (std::size_t i = 0; i < own.ids.size(); ++i) {
        const int slot = slots[own.ids.data()[i]];
        if (slot < 0)
            fail<InvalidInput>("the map of layer ", n, ", ", spec.map.string(), ", has the id ",
                               int{own.ids.data()[i]}, ", no material of the table has it");
        amounts[static_cast<std::size_t>(slot)].data()[i] = spec.thickness_m;
    }
}

}  // namespace

LayerStack layers_from_json(std::string_view text, const std::string& source,
                            const std::vector<Material>& materials,
                            const std::filesystem::path& folder) {
    if (text.size() > kMaxBytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", kMaxBytes);
    const json root = parse_strict(text, source);
    JsonObject object(root, {source, ""});
    check_format(object, "scree-layers");
    LayerStack stack;
    const JsonPlace place = object.at("layers");
    const json& list = list_of(object.get("layers"), place, kMaxLayers);
    if (list.empty())
        fail<InvalidInput>(place.text(), " is empty, at least one is needed");
    for (std::size_t i = 0; i < list.size(); ++i)
        stack.layers.push_back(layer_from(list[i], place.entry(i), materials, folder));
    if (stack.layers[0].material || !stack.layers[0].map.empty())
        fail<InvalidInput>(place.entry(0).text(),
                           " is the map itself, it takes neither material nor map");
    stack.surface_depth_m =
        object.number("surface_depth_m", stack.layers[0].thickness_m, kThinnest, kThickest);
    object.finish();
    return stack;
}

LayerStack read_layers(const std::filesystem::path& path, const std::vector<Material>& materials) {
    return layers_from_json(read_whole_file(path, kMaxBytes), path.string(), materials,
                            path.parent_path());
}

MaterialLayers make_layers(const DescriptionMap& map, const LayerStack& stack) {
    std::vector<double> thickness;
    for (const LayerSpec& layer : stack.layers)
        thickness.push_back(layer.thickness_m);
    MaterialLayers layers = layers_of_map(map, thickness);
    const auto slots = slots_of_ids(map.materials);
    for (std::size_t n = 0; n < stack.layers.size(); ++n) {
        const LayerSpec& spec = stack.layers[n];
        if (!spec.material && spec.map.empty())
            continue;
        for (Raster<double>& amounts : layers.amounts[n])
            std::fill(amounts.begin(), amounts.end(), 0.0);
        if (!spec.material) {
            lay_map(spec, map, n, layers.amounts[n]);
            continue;
        }
        const int slot = *spec.material >= 0 && *spec.material < 256
                             ? slots[static_cast<std::size_t>(*spec.material)]
                             : -1;
        if (slot < 0)
            fail<InvalidInput>("layer ", n, " is to be of id ", *spec.material,
                               ", which has no material");
        auto& amounts = layers.amounts[n][static_cast<std::size_t>(slot)];
        std::fill(amounts.begin(), amounts.end(), spec.thickness_m);
    }
    return layers;
}

}  // namespace scree::terrain
