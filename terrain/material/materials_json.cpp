#include "terrain/material/materials_json.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"
#include "terrain/material/map_check.h"
#include "terrain/json/strict_json.h"

#include <algorithm>

namespace scree::terrain {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::string_view kFormat = "scree-materials";

// ---- writing

std::string number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

// Not operator+: gcc 12 sees overlaps in it that are not there.
template <class... Parts>
void append(std::string& text, const Parts&... parts) {
    ((text += parts), ...);
}

void append_textures(std::string& text, const MaterialTextures& textures, const fs::path& folder) {
    append(text, ",\n   \"textures\": {");
    const auto path = [&](const char* name, const fs::path& file) {
        if (!file.empty())
            append(text, "\"", name, "\": ", quoted(relative_text(file, folder)), ", ");
    };
    path("albedo", textures.albedo);
    path("displacement", textures.displacement);
    path("normal", textures.normal);
    append(text, "\"size_m\": ", number(textures.size_m),
           ", \"displacement_m\": ", number(textures.displacement_m), "}");
}

void append_material(std::string& text, const Material& material, const fs::path& folder) {
    const Soil& soil = material.soil;
    append(text, "  {\"id\": ", std::to_string(material.id), ", \"name\": ", quoted(material.name),
           ", \"gravel\": ", material.gravel ? "true" : "false");
    append(text, ",\n   \"repose_deg\": ", number(soil.repose_deg),
           ", \"mobility\": ", number(soil.mobility), ", \"diffusion\": ", number(soil.diffusion),
           ", \"compaction\": ", number(soil.compaction));
    if (material.textures != MaterialTextures{})
        append_textures(text, material.textures, folder);
    if (material.hat != HatShape{})
        append(text, ",\n   \"hat\": [", number(material.hat.start), ", ",
               number(material.hat.peak), ", ", number(material.hat.end), "]");
    if (material.colour) {
        const glm::u8vec3 c = *material.colour;
        append(text, ",\n   \"colour\": [", std::to_string(c.x), ", ", std::to_string(c.y), ", ",
               std::to_string(c.z), "]");
    }
    append(text, "}");
}

// ---- reading

fs::path path_member(JsonObject& object, std::string_view name, const fs::path& folder) {
    return resolved_path(object.text(name, ""), folder);
}

MaterialTextures textures_from(const json& value, const JsonPlace& place, const fs::path& folder) {
    JsonObject object(value, place);
    MaterialTextures textures;
    textures.albedo = path_member(object, "albedo", folder);
    textures.displacement = path_member(object, "displacement", folder);
    textures.normal = path_member(object, "normal", folder);
    textures.size_m = object.number("size_m", textures.size_m, 1e-9, 1e6);
    textures.displacement_m = object.number("displacement_m", textures.displacement_m, 0.0, 1e6);
    object.finish();
    return textures;
}

const json& list_of_three(const json& value, const JsonPlace& place) {
    if (list_of(value, place, 3).size() != 3)
        fail<InvalidInput>(place.text(), " must have 3 entries, has ", value.size());
    return value;
}

HatShape hat_from(const json& value, const JsonPlace& place) {
    list_of_three(value, place);
    const auto at = [&](std::size_t i) { return number_of(value[i], place.entry(i), -1.0, 1.0); };
    return {at(0), at(1), at(2)};
}

glm::u8vec3 colour_from(const json& value, const JsonPlace& place) {
    list_of_three(value, place);
    const auto at = [&](std::size_t i) {
        return static_cast<std::uint8_t>(integer_of(value[i], place.entry(i), 0, 255));
    };
    return {at(0), at(1), at(2)};
}

Material material_from(const json& value, const JsonPlace& place, const fs::path& folder) {
    JsonObject object(value, place);
    Material material;
    material.id = integer_of(object.get("id"), object.at("id"), 0, 255);
    material.name = text_of(object.get("name"), object.at("name"));
    material.gravel = object.flag("gravel", false);
    Soil& soil = material.soil;
    soil.repose_deg = object.number("repose_deg", soil.repose_deg, 0.0, 89.0);
    soil.mobility = object.number("mobility", soil.mobility, 0.0, 16.0);
    soil.diffusion = object.number("diffusion", soil.diffusion, 0.0, 4.0);
    soil.compaction = object.number("compaction", soil.compaction, 0.0, 1.0);
    if (const json* textures = object.find("textures"))
        material.textures = textures_from(*textures, object.at("textures"), folder);
    if (const json* hat = object.find("hat"))
        material.hat = hat_from(*hat, object.at("hat"));
    if (const json* colour = object.find("colour"))
        material.colour = colour_from(*colour, object.at("colour"));
    object.finish();
    return material;
}

}  // namespace

std::string relative_text(const fs::path& path, const fs::path& folder) {
    if (path.empty())
        return {};
    const fs::path from = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
    const fs::path to = fs::absolute(path).lexically_normal();
    return to.lexically_relative(from).generic_string();
}

fs::path resolved_path(const std::string& text, const fs::path& folder) {
    return text.empty() ? fs::path() : (folder / fs::path(text)).lexically_normal();
}

std::string materials_to_json(const MaterialTable& table, const fs::path& folder) {
    check_materials(table.materials, "the table of materials");
    std::string text;
    append(text, "{\n \"format\": \"", kFormat, "\",\n \"version\": 1,\n");
    append(text, " \"cell_size\": ", number(table.cell_size), ",\n");
    if (!table.ids.empty())
        append(text, " \"ids\": ", quoted(relative_text(table.ids, folder)), ",\n");
    if (!table.parameters.empty())
        append(text, " \"parameters\": ", quoted(relative_text(table.parameters, folder)), ",\n");
    append(text, " \"materials\": [\n");
    for (std::size_t i = 0; i < table.materials.size(); ++i) {
        append_material(text, table.materials[i], folder);
        append(text, i + 1 < table.materials.size() ? ",\n" : "\n");
    }
    append(text, " ]\n}\n");
    return text;
}

MaterialTable materials_from_json(std::string_view text, const std::string& source,
                                  const fs::path& folder) {
    if (text.size() > kMaxMaterialsBytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ",
                           kMaxMaterialsBytes);
    const json root = parse_strict(text, source);
    JsonObject object(root, {source, ""});
    check_format(object, kFormat);
    MaterialTable table;
    table.cell_size = object.number("cell_size", 1.0, 1e-9, 1e6);
    table.ids = path_member(object, "ids", folder);
    table.parameters = path_member(object, "parameters", folder);
    const JsonPlace place = object.at("materials");
    const json& list = list_of(object.get("materials"), place, kMaxMaterials);
    for (std::size_t i = 0; i < list.size(); ++i)
        table.materials.push_back(material_from(list[i], place.entry(i), folder));
    object.finish();
    std::stable_sort(table.materials.begin(), table.materials.end(),
                     [](const Material& a, const Material& b) { return a.id < b.id; });
    check_materials(table.materials, source);
    return table;
}

MaterialTable read_materials(const fs::path& path) {
    return materials_from_json(read_whole_file(path, kMaxMaterialsBytes), path.string(),
                               path.parent_path());
}

}  // namespace scree::terrain
