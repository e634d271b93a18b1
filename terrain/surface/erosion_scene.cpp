#include "terrain/surface/erosion_scene.h"

#include "base/error.h"
#include "terrain/surface/json_object.h"

#include <algorithm>
#include <sstream>

namespace scree::terrain {
namespace {

constexpr std::string_view kFormat = "scree-erosion";
constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestReason = 160;
constexpr double kBedPieces = 64.0;

void read_mesh(JsonObject mesh, ErosionScene& scene) {
    if (mesh.has("file") == mesh.has("ground"))
        mesh.refuse("", "must have either `file` or `ground`");
    if (mesh.has("file")) {
        scene.mesh_file = mesh.text("file");
        if (scene.mesh_file.empty())
            mesh.refuse("file", "must name a file");
    } else {
        JsonObject ground = mesh.object("ground");
        ground.options(scene.ground);
        ground.finish();
    }
    mesh.finish();
}

FluidBox read_box(JsonObject box) {
    FluidBox result{box.vector("low"), box.vector("high")};
    for (int c = 0; c < 3; ++c)
        if (!(result.low[c] < result.high[c]))
            box.refuse("low", "must be below `high` in every number");
    box.finish();
    return result;
}

// At least `least`, so that a wrong number is named by its place in the file.
void read_above(JsonObject& object, const std::string& key, double& value, double least) {
    object.number(key, value);
    if (!(value > least)) {
        std::ostringstream what;
        what << "is " << value << ", must be above " << least;
        object.refuse(key, what.str());
    }
}

template <class Emitter>
void read_times(JsonObject& object, Emitter& emitter) {
    object.number("start", emitter.start);
    object.number("end", emitter.end);
    if (!(emitter.start >= 0.0))
        object.refuse("start", "must not be negative");
    if (!(emitter.end > emitter.start))
        object.refuse("end", "must come after `start`");
}

FluidSource read_source(JsonObject object) {
    FluidSource source;
    source.centre = object.vector("centre");
    source.velocity = object.vector("velocity");
    read_above(object, "radius", source.radius, 0.0);
    read_times(object, source);
    object.finish();
    return source;
}

FluidRain read_rain(JsonObject object) {
    FluidRain rain;
    rain.centre = object.vector("centre");
    read_above(object, "width", rain.width, 0.0);
    read_above(object, "depth", rain.depth, 0.0);
    read_above(object, "rate", rain.rate, 0.0);
    object.vector("velocity", rain.velocity);
    read_times(object, rain);
    object.finish();
    return rain;
}

void read_water(JsonObject& fluid, ErosionScene& scene) {
    PositionFluidSetup& water = scene.water;
    fluid.options(water.options);
    fluid.vector("gravity", water.gravity);
    if (fluid.has("domain"))
        water.domain = read_box(fluid.object("domain"));
    for (JsonObject& source : fluid.objects("sources"))
        water.emitters.sources.push_back(read_source(std::move(source)));
    for (JsonObject& rain : fluid.objects("rains"))
        water.emitters.rains.push_back(read_rain(std::move(rain)));
    for (JsonObject& pool : fluid.objects("pools"))
        water.emitters.pools.push_back(read_box(std::move(pool)));
    for (JsonObject& sink : fluid.objects("sinks"))
        water.emitters.sinks.push_back(read_box(std::move(sink)));
}

// The bed of a ground of ours, raised by `height`.
std::vector<glm::vec3> path_along_bed(const GroundOptions& ground, double height) {
    std::vector<glm::vec3> path;
    for (double k = 0.0; k <= kBedPieces; ++k)
        path.push_back(bed_at(ground, (k / kBedPieces - 0.5) * ground.length) +
                       glm::vec3(0.0F, static_cast<float>(height), 0.0F));
    return path;
}

ScriptedStream read_stream(JsonObject object, const ErosionScene& scene) {
    ScriptedStream stream;
    if (object.has("path") == object.has("above_bed"))
        object.refuse("", "must have either `path` or `above_bed`");
    if (object.has("path")) {
        stream.path = object.vectors("path");
    } else {
        const double height = object.number("above_bed");
        if (!scene.mesh_file.empty() || scene.ground.shape == GroundShape::Block)
            object.refuse("above_bed", "needs a ground with a bed; give a `path`");
        stream.path = path_along_bed(scene.ground, height);
    }
    read_above(object, "speed", stream.speed, 0.0);
    object.number("half_width", stream.half_width);
    object.number("half_height", stream.half_height);
    read_above(object, "per_metre", stream.per_metre, 0.0);
    object.finish();
    return stream;
}

void read_fluid(JsonObject fluid, ErosionScene& scene) {
    const std::string kind = fluid.text("kind");
    const auto* known = std::find(std::begin(kFluidKindNames), std::end(kFluidKindNames), kind);
    if (known == std::end(kFluidKindNames))
        fluid.refuse("kind", "must be one of particles, scripted");
    scene.fluid_kind = static_cast<FluidKind>(known - std::begin(kFluidKindNames));
    if (scene.fluid_kind == FluidKind::Particles) {
        read_water(fluid, scene);
    } else {
        fluid.options(scene.script);
        for (JsonObject& stream : fluid.objects("streams"))
            scene.streams.push_back(read_stream(std::move(stream), scene));
        if (scene.streams.empty())
            fluid.refuse("streams", "must hold at least one stream");
    }
    fluid.finish();
}

template <class Options>
void read_options(JsonObject& root, const std::string& key, Options& options) {
    if (!root.has(key))
        return;
    JsonObject object = root.object(key);
    object.options(options);
    object.finish();
}

nlohmann::json parse(std::string_view text, const std::string& source) {
    if (text.size() > kMostBytes)
        fail<InvalidInput>(source, " is larger than a scene may be (", kMostBytes, " bytes)");
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        std::string_view reason = error.what();
        const auto start = reason.find("] ");
        reason = reason.substr(start == std::string_view::npos ? 0 : start + 2, kLongestReason);
        fail<InvalidInput>(source, " is no JSON: ", reason);
    }
}

}  // namespace

ErosionScene erosion_scene_from_json(std::string_view text, const std::string& source) {
    const nlohmann::json json = parse(text, source);
    JsonObject root(json, source, "");
    if (root.text("format") != kFormat)
        root.refuse("format", "must be \"" + std::string(kFormat) + "\"");
    if (root.number("version") != 1.0)
        root.refuse("version", "must be 1");
    ErosionScene scene;
    read_mesh(root.object("mesh"), scene);
    read_fluid(root.object("fluid"), scene);
    read_options(root, "run", scene.run);
    read_options(root, "wear", scene.wear);
    read_options(root, "sediment", scene.sediment);
    read_options(root, "output", scene.output);
    root.finish();
    return scene;
}

std::unique_ptr<ParticleFluid> make_fluid(const ErosionScene& scene) {
    if (scene.fluid_kind == FluidKind::Scripted)
        return std::make_unique<ScriptedFluid>(scene.streams, scene.script);
    return std::make_unique<PositionFluid>(scene.water);
}

}  // namespace scree::terrain
