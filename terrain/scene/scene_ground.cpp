#include "base/error.h"
#include "terrain/material/material_reference.h"
#include "terrain/scene/scene_json.h"

#include <limits>

#include <glm/common.hpp>

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr double kFar = 1e6;  // metres
constexpr std::size_t kMaxShapes = 256;
constexpr std::size_t kMaxCorners = 10'000;
constexpr std::string_view kShapes[] = {"hills", "ripples", "pile", "dune", "ramp", "mound"};

GroundShape ground_shape_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    GroundShape shape;
    shape.kind =
        static_cast<GroundShape::Kind>(word_of(object.get("kind"), object.at("kind"), kShapes));
    if (const json* centre = object.find("centre_m"))
        shape.centre_m = pair_of(*centre, object.at("centre_m"));
    shape.height_m = object.number("height_m", shape.height_m, -1e4, 1e4);
    shape.length_m = object.number("length_m", shape.length_m, 1e-6, 1e6);
    shape.slope_deg = object.number("slope_deg", shape.slope_deg, -85.0, 85.0);
    shape.direction_deg = object.number("direction_deg", 0.0, -360.0, 360.0);
    if (const json* octaves = object.find("octaves"))
        shape.octaves = integer_of(*octaves, object.at("octaves"), 1, 12);
    if (const json* seed = object.find("seed"))
        shape.seed = static_cast<std::uint64_t>(
            integer_of(*seed, object.at("seed"), 0, std::numeric_limits<int>::max()));
    const bool steep =
        shape.kind == GroundShape::Kind::Pile || shape.kind == GroundShape::Kind::Dune;
    if (steep && !(shape.slope_deg >= 1.0))
        fail<InvalidInput>(object.at("slope_deg").text(), " is ", shape.slope_deg,
                           ", a flank needs at least 1");
    object.finish();
    return shape;
}

}  // namespace

GroundSpec ground_from(const json& value, const JsonPlace& place,
                       const std::filesystem::path& folder, Scene& scene) {
    JsonObject object(value, place);
    GroundSpec ground;
    ground.cell_size_m = number_of(object.get("cell_size_m"), object.at("cell_size_m"), 1e-6, 1e6);
    if (const json* heights = object.find("heights")) {
        ground.heights = file_of(*heights, object.at("heights"), folder, scene);
        ground.width = ground.height = 0;  // the picture's
        ground.height_scale = object.number("height_scale", 1.0, -1e6, 1e6);
    } else {
        ground.width = integer_of(object.get("width"), object.at("width"), 2, kMaxGroundSide);
        ground.height = integer_of(object.get("height"), object.at("height"), 2, kMaxGroundSide);
    }
    if (const json* shapes = object.find("shapes")) {
        list_of(*shapes, object.at("shapes"), kMaxShapes);
        for (std::size_t i = 0; i < shapes->size(); ++i)
            ground.shapes.push_back(ground_shape_from((*shapes)[i], object.at("shapes").entry(i)));
    }
    object.finish();
    return ground;
}

MaterialRegion region_from(const json& value, const JsonPlace& place,
                           const std::vector<Material>& materials) {
    JsonObject object(value, place);
    MaterialRegion region;
    region.material = material_id(object.get("material"), object.at("material"), materials);
    const json* rect = object.find("rect_m");
    const json* disc = object.find("disc_m");
    const json* polygon = object.find("polygon_m");
    if ((rect != nullptr) + (disc != nullptr) + (polygon != nullptr) != 1)
        fail<InvalidInput>(place.text(), " must have one of rect_m, disc_m and polygon_m");
    if (rect != nullptr) {
        list_of(*rect, object.at("rect_m"), 4);
        if (rect->size() != 4)
            fail<InvalidInput>(object.at("rect_m").text(), " must have 4 entries (x, z, x, z)");
        double at[4];
        for (std::size_t i = 0; i < 4; ++i)
            at[i] = number_of((*rect)[i], object.at("rect_m").entry(i), -kFar, kFar);
        region.polygon = {{at[0], at[1]}, {at[2], at[1]}, {at[2], at[3]}, {at[0], at[3]}};
    } else if (disc != nullptr) {
        const glm::dvec3 circle = triple_of(*disc, object.at("disc_m"));
        region.centre_m = {circle.x, circle.y};
        region.radius_m = circle.z;
        if (!(region.radius_m > 0.0))
            fail<InvalidInput>(object.at("disc_m").text(), " must be x, z and a positive radius");
    } else {
        list_of(*polygon, object.at("polygon_m"), kMaxCorners);
        if (polygon->size() < 3)
            fail<InvalidInput>(object.at("polygon_m").text(), " must have at least 3 corners");
        for (std::size_t i = 0; i < polygon->size(); ++i)
            region.polygon.push_back(pair_of((*polygon)[i], object.at("polygon_m").entry(i)));
    }
    region.ragged_m = object.number("ragged_m", 0.0, 0.0, kFar);
    object.finish();
    return region;
}

}  // namespace scree::terrain
