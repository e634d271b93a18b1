#include "terrain/surface/erosion_scene.h"

#include "base/error.h"
#include "terrain/json/json_values.h"

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr std::string_view kFormat = "scree-erosion";
constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestList = 10000;
constexpr double kFarthest = 1e9;  // metres, seconds, particles
constexpr double kBedPieces = 64.0;

glm::vec3 vector_of(JsonObject& object, std::string_view name) {
    return glm::vec3(triple_of(object.get(name), object.at(name)));
}

// Every entry of a list of objects, which may be absent.
template <class Read>
void read_each(JsonObject& object, std::string_view name, const Read& read) {
    const json* found = object.find(name);
    if (found == nullptr)
        return;
    const json& list = list_of(*found, object.at(name), kLongestList);
    for (std::size_t i = 0; i < list.size(); ++i) {
        JsonObject entry(list[i], object.at(name).entry(i));
        read(entry);
        entry.finish();
    }
}

template <class Options>
void read_options_member(JsonObject& root, std::string_view name, Options& options) {
    const json* found = root.find(name);
    if (found == nullptr)
        return;
    JsonObject object(*found, root.at(name));
    read_options(object, options);
    object.finish();
}

// True if the first of two members is there; one of them must be, and not both.
bool first_of_two(JsonObject& object, std::string_view first, std::string_view second) {
    const bool has_first = object.find(first) != nullptr;
    if (has_first == (object.find(second) != nullptr))
        fail<InvalidInput>(object.place().text(), " must have either ", first, " or ", second);
    return has_first;
}

void read_mesh(JsonObject& mesh, ErosionScene& scene) {
    if (!first_of_two(mesh, "file", "ground")) {
        read_options_member(mesh, "ground", scene.ground);
        return;
    }
    scene.mesh_file = text_of(mesh.get("file"), mesh.at("file"));
    if (scene.mesh_file.empty())
        fail<InvalidInput>(mesh.at("file").text(), " is empty, it must name a file");
}

FluidBox read_box(JsonObject& box) {
    const FluidBox result{vector_of(box, "low"), vector_of(box, "high")};
    for (int c = 0; c < 3; ++c)
        if (!(result.low[c] < result.high[c]))
            fail<InvalidInput>(box.at("low").text(), " must be below high in every number");
    return result;
}

// A number above `least`, so that a wrong one is named by its place in the file.
double above(JsonObject& object, std::string_view name, double otherwise, double least) {
    const double value = object.number(name, otherwise, -kFarthest, kFarthest);
    if (!(value > least))
        fail<InvalidInput>(object.at(name).text(), " is ", value, ", must be above ", least);
    return value;
}

template <class Emitter>
void read_times(JsonObject& object, Emitter& emitter) {
    emitter.start = object.number("start", emitter.start, 0.0, kFarthest);
    const double least = emitter.start;
    if (object.find("end") != nullptr)
        emitter.end = above(object, "end", emitter.end, least);
    else if (!(emitter.end > least))
        fail<InvalidInput>(object.at("start").text(), " is ", least, ", after the end");
}

FluidSource read_source(JsonObject& object) {
    FluidSource source;
    source.centre = vector_of(object, "centre");
    source.velocity = vector_of(object, "velocity");
    source.radius = above(object, "radius", source.radius, 0.0);
    read_times(object, source);
    return source;
}

FluidRain read_rain(JsonObject& object) {
    FluidRain rain;
    rain.centre = vector_of(object, "centre");
    rain.width = above(object, "width", rain.width, 0.0);
    rain.depth = above(object, "depth", rain.depth, 0.0);
    rain.rate = above(object, "rate", rain.rate, 0.0);
    if (object.find("velocity") != nullptr)
        rain.velocity = vector_of(object, "velocity");
    read_times(object, rain);
    return rain;
}

void read_water(JsonObject& fluid, ErosionScene& scene) {
    PositionFluidSetup& water = scene.water;
    read_options(fluid, water.options);
    if (fluid.find("gravity") != nullptr)
        water.gravity = vector_of(fluid, "gravity");
    if (const json* domain = fluid.find("domain")) {
        JsonObject box(*domain, fluid.at("domain"));
        water.domain = read_box(box);
        box.finish();
    }
    FluidEmitters& emitters = water.emitters;
    read_each(fluid, "sources",
              [&](JsonObject& entry) { emitters.sources.push_back(read_source(entry)); });
    read_each(fluid, "rains",
              [&](JsonObject& entry) { emitters.rains.push_back(read_rain(entry)); });
    read_each(fluid, "pools",
              [&](JsonObject& entry) { emitters.pools.push_back(read_box(entry)); });
    read_each(fluid, "sinks",
              [&](JsonObject& entry) { emitters.sinks.push_back(read_box(entry)); });
}

// The bed of a ground of ours, raised by `height`.
std::vector<glm::vec3> path_along_bed(const GroundOptions& ground, double height) {
    std::vector<glm::vec3> path;
    for (double k = 0.0; k <= kBedPieces; ++k)
        path.push_back(bed_at(ground, (k / kBedPieces - 0.5) * ground.length) +
                       glm::vec3(0.0F, static_cast<float>(height), 0.0F));
    return path;
}

ScriptedStream read_stream(JsonObject& object, const ErosionScene& scene) {
    ScriptedStream stream;
    if (first_of_two(object, "path", "above_bed")) {
        const JsonPlace place = object.at("path");
        const json& path = list_of(object.get("path"), place, kLongestList);
        for (std::size_t i = 0; i < path.size(); ++i)
            stream.path.emplace_back(triple_of(path[i], place.entry(i)));
    } else {
        const double height = object.number("above_bed", 0.0, -kFarthest, kFarthest);
        if (!scene.mesh_file.empty() || scene.ground.shape == GroundShape::Block)
            fail<InvalidInput>(object.at("above_bed").text(),
                               " needs a ground with a bed; give a path");
        stream.path = path_along_bed(scene.ground, height);
    }
    stream.speed = above(object, "speed", stream.speed, 0.0);
    stream.half_width = object.number("half_width", stream.half_width, -kFarthest, kFarthest);
    stream.half_height = object.number("half_height", stream.half_height, -kFarthest, kFarthest);
    stream.per_metre = above(object, "per_metre", stream.per_metre, 0.0);
    return stream;
}

void read_fluid(JsonObject& fluid, ErosionScene& scene) {
    scene.fluid_kind =
        static_cast<FluidKind>(word_of(fluid.get("kind"), fluid.at("kind"), kFluidKindNames));
    if (scene.fluid_kind == FluidKind::Particles) {
        read_water(fluid, scene);
        return;
    }
    read_options(fluid, scene.script);
    read_each(fluid, "streams",
              [&](JsonObject& entry) { scene.streams.push_back(read_stream(entry, scene)); });
    if (scene.streams.empty())
        fail<InvalidInput>(fluid.at("streams").text(), " must hold at least one stream");
}

}  // namespace

ErosionScene erosion_scene_from_json(std::string_view text, const std::string& source) {
    if (text.size() > kMostBytes)
        fail<InvalidInput>(source, " is larger than a scene may be (", kMostBytes, " bytes)");
    const json parsed = parse_strict(text, source);
    JsonObject root(parsed, {source, ""});
    check_format(root, kFormat);
    ErosionScene scene;
    JsonObject mesh(root.get("mesh"), root.at("mesh"));
    read_mesh(mesh, scene);
    mesh.finish();
    JsonObject fluid(root.get("fluid"), root.at("fluid"));
    read_fluid(fluid, scene);
    fluid.finish();
    read_options_member(root, "run", scene.run);
    read_options_member(root, "wear", scene.wear);
    read_options_member(root, "sediment", scene.sediment);
    read_options_member(root, "output", scene.output);
    root.finish();
    return scene;
}

std::unique_ptr<ParticleFluid> make_fluid(const ErosionScene& scene) {
    if (scene.fluid_kind == FluidKind::Scripted)
        return std::make_unique<ScriptedFluid>(scene.streams, scene.script);
    return std::make_unique<PositionFluid>(scene.water);
}

}  // namespace scree::terrain
