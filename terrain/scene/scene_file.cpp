#include "terrain/scene/scene_file.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "terrain/material/materials_json.h"
#include "terrain/scene/scene_json.h"

#include <algorithm>
#include <limits>

namespace scree::terrain {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path file_of(const json& value, const JsonPlace& place, const fs::path& folder, Scene& scene) {
    const std::string text = text_of(value, place);
    if (text.empty())
        fail<InvalidInput>(place.text(), " is empty, it must name a file");
    const fs::path path = resolved_path(text, folder);
    scene.files.emplace_back(path, place.text());
    return path;
}

namespace {

constexpr std::string_view kFormat = "scree-scene";
constexpr double kBounds[] = {0.25, 0.25, 0.125};  // of Slide's values

// The table's own reader checks it: the same messages for a table here and one in a file.
void read_materials_member(const json& value, const JsonPlace& place, const fs::path& folder,
                           Scene& scene) {
    list_of(value, place, 256);
    const json table = {
        {"format", "scree-materials"}, {"version", 1}, {"cell_size", 1.0}, {"materials", value}};
    scene.materials =
        materials_from_json(table.dump(-1, ' ', false, json::error_handler_t::replace),
                            place.source, folder)
            .materials;
    if (scene.materials.empty())
        fail<InvalidInput>(place.text(), " is empty, one material at least covers the ground");
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const MaterialTextures& textures = scene.materials[i].textures;
        for (const fs::path& file : {textures.albedo, textures.displacement, textures.normal})
            if (!file.empty())
                scene.files.emplace_back(
                    file, place.text() + " (textures of " + scene.materials[i].name + ")");
    }
}

void read_bearing(const json& value, const JsonPlace& place, Scene& scene) {
    if (!value.is_object())
        refuse_kind(place, value, "an object");
    for (const auto& [name, stiffness] : value.items()) {
        const bool known =
            !scene.map.empty() ||
            std::any_of(scene.materials.begin(), scene.materials.end(),
                        [&name = name](const Material& m) { return m.name == name; });
        if (!known)
            fail<InvalidInput>(place.text(), " names ", quoted(name.substr(0, 64)),
                               ", which is no name in materials");
        scene.bearing[name] = number_of(stiffness, place.member(name.substr(0, 64)), 1e-3, 1e9);
    }
}

void check_stability(const Scene& scene, const JsonPlace& place) {
    if (scene.deformer.reading != Reading::Sound)
        return;
    const double bound = kBounds[static_cast<std::size_t>(scene.deformer.slide)];
    for (const Material& material : scene.materials) {
        const double step = material.soil.diffusion * scene.deformer.time_step;
        if (step > bound * (1.0 + 1e-6))
            fail<InvalidInput>(place.member("deformer.time_step").text(), " is ",
                               scene.deformer.time_step, " and the diffusion of ", material.name,
                               " ", material.soil.diffusion, ": their product ", step,
                               " is beyond the stability bound ", bound, ", lower one of them");
    }
}

// settle_to_rest() finds rest states of the sound form over a closed rim.
void read_settle(JsonObject& object, Scene& scene) {
    scene.settle = object.flag("settle", false);
    if (scene.settle && scene.deformer.reading == Reading::Literal)
        fail<InvalidInput>(object.at("settle").text(),
                           " is true, but the literal reading has no rest at its repose; take "
                           "the sound one");
    if (scene.settle && scene.deformer.border == Border::Zero)
        fail<InvalidInput>(object.at("settle").text(),
                           " is true, but settling closes the rim; take border no-flux");
}

SceneCamera camera_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    SceneCamera camera;
    camera.azimuth_deg = object.number("azimuth_deg", camera.azimuth_deg, -360, 360);
    camera.elevation_deg = object.number("elevation_deg", camera.elevation_deg, 5, 89);
    camera.field_of_view_deg = object.number("field_of_view_deg", camera.field_of_view_deg, 1, 120);
    camera.light_azimuth_deg =
        object.number("light_azimuth_deg", camera.light_azimuth_deg, -360, 360);
    camera.light_elevation_deg =
        object.number("light_elevation_deg", camera.light_elevation_deg, 1, 90);
    if (const json* eye = object.find("eye_m"))
        camera.eye_m = triple_of(*eye, object.at("eye_m"));
    if (const json* target = object.find("target_m"))
        camera.target_m = triple_of(*target, object.at("target_m"));
    if (camera.eye_m.has_value() != camera.target_m.has_value())
        fail<InvalidInput>(place.text(), " must have both eye_m and target_m, or none of them");
    if (camera.eye_m && *camera.eye_m == *camera.target_m)
        fail<InvalidInput>(object.at("target_m").text(), " is where the eye is");
    object.finish();
    return camera;
}

SceneOutputs outputs_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    SceneOutputs out;
    const auto whole = [&](const char* name, int& number, int low, int high) {
        if (const json* found = object.find(name))
            number = integer_of(*found, object.at(name), low, high);
    };
    whole("picture_width", out.picture_width, 16, 4096);
    whole("picture_height", out.picture_height, 16, 4096);
    whole("every", out.every, 1, 100'000);
    whole("preview_width", out.preview_width, 16, 1920);
    whole("mesh_side", out.mesh_side, 2, 4096);
    whole("texture_side", out.texture_side, 16, 8192);
    object.finish();
    return out;
}

SceneRocks rocks_from(const json& value, const JsonPlace& place, const fs::path& folder,
                      Scene& scene) {
    JsonObject object(value, place);
    SceneRocks rocks;
    rocks.file = file_of(object.get("file"), object.at("file"), folder, scene);
    object.get("near_m");
    rocks.near_m = object.number("near_m", 0.0, 0, 1e6);
    object.finish();
    return rocks;
}

void read_ground_members(JsonObject& object, const fs::path& folder, Scene& scene) {
    scene.ground = ground_from(object.get("ground"), object.at("ground"), folder, scene);
    const json* map = object.find("map");
    const json* materials = object.find("materials");
    if (map != nullptr && materials != nullptr)
        fail<InvalidInput>(object.at("map").text(), " stands beside materials, give one of them");
    if (map != nullptr)
        scene.map = file_of(*map, object.at("map"), folder, scene);
    else if (materials != nullptr)
        read_materials_member(*materials, object.at("materials"), folder, scene);
    else
        scene.materials.emplace_back().name = "sand";
    if (const json* regions = object.find("regions")) {
        list_of(*regions, object.at("regions"), 10'000);
        if (map != nullptr)
            fail<InvalidInput>(object.at("regions").text(),
                               " stand beside map, which says where each material lies");
        for (std::size_t i = 0; i < regions->size(); ++i)
            scene.regions.push_back(
                region_from((*regions)[i], object.at("regions").entry(i), scene.materials));
    }
    if (const json* bearing = object.find("bearing_kpa_per_m"))
        read_bearing(*bearing, object.at("bearing_kpa_per_m"), scene);
}

template <class Options>
void read_option_member(JsonObject& object, const char* name, Options& options) {
    if (const json* value = object.find(name)) {
        JsonObject member(*value, object.at(name));
        read_options(member, options);
        member.finish();
    }
}

}  // namespace

Scene scene_from_json(std::string_view text, const std::string& source, const fs::path& folder) {
    if (text.size() > kMaxSceneBytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", kMaxSceneBytes);
    const json root = parse_strict(text, source);
    JsonObject object(root, {source, ""});
    check_format(object, kFormat);
    Scene scene;
    scene.source = source;
    read_ground_members(object, folder, scene);
    if (const json* objects = object.find("objects")) {
        list_of(*objects, object.at("objects"), kMaxSceneObjects);
        for (std::size_t i = 0; i < objects->size(); ++i)
            scene.objects.push_back(
                object_from((*objects)[i], object.at("objects").entry(i), folder, scene));
    }
    read_option_member(object, "deformer", scene.deformer);
    read_option_member(object, "contact", scene.contact);
    check_stability(scene, object.place());
    read_settle(object, scene);
    if (const json* frames = object.find("frames"))
        scene.frames = integer_of(*frames, object.at("frames"), 1, 100'000);
    scene.frame_rate = object.number("frame_rate", scene.frame_rate, 1e-3, 1e4);
    if (const json* substeps = object.find("substeps"))
        scene.substeps = integer_of(*substeps, object.at("substeps"), 0, 1000);
    if (const json* seed = object.find("seed"))
        scene.seed = static_cast<std::uint64_t>(
            integer_of(*seed, object.at("seed"), 0, std::numeric_limits<int>::max()));
    if (const json* camera = object.find("camera"))
        scene.camera = camera_from(*camera, object.at("camera"));
    if (const json* rocks = object.find("rocks"))
        scene.rocks = rocks_from(*rocks, object.at("rocks"), folder, scene);
    if (const json* outputs = object.find("outputs"))
        scene.outputs = outputs_from(*outputs, object.at("outputs"));
    object.finish();
    return scene;
}

Scene read_scene(const fs::path& path) {
    Scene scene =
        scene_from_json(read_whole_file(path, kMaxSceneBytes), path.string(), path.parent_path());
    for (const auto& [file, place] : scene.files) {
        std::error_code ignored;
        if (!fs::is_regular_file(file, ignored))
            fail<InvalidInput>(place, " names ", file.string(), ", which is no file");
    }
    return scene;
}

}  // namespace scree::terrain
