#include "base/error.h"
#include "terrain/scene/scene_file.h"
#include "terrain/scene/scene_json.h"

#include <algorithm>
#include <numbers>

#include <glm/ext/quaternion_trigonometric.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr double kFar = 1e6;  // metres or seconds
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr std::string_view kShapes[] = {"sphere", "box", "tyre", "boot", "mesh"};
constexpr std::string_view kRides[] = {"path", "sink", "weight"};

template <class Shape>
ObjectShape described_shape(JsonObject& object) {
    Shape shape;
    read_options(object, shape);
    return shape;
}

ObjectShape shape_from(const json& value, const JsonPlace& place,
                       const std::filesystem::path& folder, Scene& scene) {
    JsonObject object(value, place);
    ObjectShape shape;
    switch (word_of(object.get("kind"), object.at("kind"), kShapes)) {
        case 0:
            shape = described_shape<SphereShape>(object);
            break;
        case 1: {
            BoxShape box;
            if (const json* size = object.find("size_m"))
                box.size_m = triple_of(*size, object.at("size_m"));
            if (!(std::min({box.size_m.x, box.size_m.y, box.size_m.z}) >= 1e-4 &&
                  std::max({box.size_m.x, box.size_m.y, box.size_m.z}) <= 1e3))
                fail<InvalidInput>(object.at("size_m").text(),
                                   " must hold lengths in [0.0001, 1000]");
            shape = box;
            break;
        }
        case 2:
            shape = described_shape<TyreShape>(object);
            break;
        case 3:
            shape = described_shape<BootShape>(object);
            break;
        default:
            shape = MeshFile{file_of(object.get("file"), object.at("file"), folder, scene)};
            break;
    }
    object.finish();
    return shape;
}

// Euler angles in degrees: about y (heading), then the object's own z (pitch), then its own x.
glm::dquat turned(const glm::dvec3& degrees) {
    return glm::angleAxis(degrees.y * kRadians, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(degrees.z * kRadians, glm::dvec3(0, 0, 1)) *
           glm::angleAxis(degrees.x * kRadians, glm::dvec3(1, 0, 0));
}

glm::dquat quaternion_of(const json& value, const JsonPlace& place) {
    list_of(value, place, 4);
    if (value.size() != 4)
        fail<InvalidInput>(place.text(), " must have 4 entries (x, y, z, w), has ", value.size());
    double parts[4];
    for (std::size_t i = 0; i < 4; ++i)
        parts[i] = number_of(value[i], place.entry(i), -2.0, 2.0);
    const glm::dquat q(parts[3], parts[0], parts[1], parts[2]);
    if (!(glm::length(q) > 1e-3))
        fail<InvalidInput>(place.text(), " is no rotation: its length is ", glm::length(q));
    return glm::normalize(q);
}

MotionKey key_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    MotionKey key;
    key.time_s = number_of(object.get("time_s"), object.at("time_s"), -kFar, kFar);
    key.pose.position = triple_of(object.get("position_m"), object.at("position_m"));
    const json* degrees = object.find("rotation_deg");
    const json* quaternion = object.find("quaternion");
    if (degrees != nullptr && quaternion != nullptr)
        fail<InvalidInput>(object.at("quaternion").text(),
                           " stands beside rotation_deg, give one of them");
    if (degrees != nullptr)
        key.pose.rotation = turned(triple_of(*degrees, object.at("rotation_deg")));
    if (quaternion != nullptr)
        key.pose.rotation = quaternion_of(*quaternion, object.at("quaternion"));
    key.pose.scale = object.number("scale", 1.0, 1e-6, 1e6);
    object.finish();
    return key;
}

Rolling rolling_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    Rolling rolling;
    rolling.radius_m = number_of(object.get("radius_m"), object.at("radius_m"), 1e-6, 1e6);
    if (const json* axis = object.find("axis"))
        rolling.axis = triple_of(*axis, object.at("axis"));
    if (!(glm::length(rolling.axis) > 1e-6))
        fail<InvalidInput>(object.at("axis").text(), " is no direction");
    rolling.axis = glm::normalize(rolling.axis);
    object.finish();
    return rolling;
}

}  // namespace

ObjectMotion motion_from(const json& value, const JsonPlace& place) {
    JsonObject object(value, place);
    ObjectMotion motion;
    const json& keys = list_of(object.get("keys"), object.at("keys"), kMaxMotionKeys);
    for (std::size_t i = 0; i < keys.size(); ++i)
        motion.keys.push_back(key_from(keys[i], object.at("keys").entry(i)));
    if (const json* rolling = object.find("rolling"))
        motion.rolling = rolling_from(*rolling, object.at("rolling"));
    if (const json* ride = object.find("ride"))
        motion.ride = static_cast<Ride>(word_of(*ride, object.at("ride"), kRides));
    motion.sink_m = object.number("sink_m", 0.0, -kFar, kFar);
    motion.from_s = object.number("from_s", motion.from_s, -kFar, kFar);
    motion.to_s = object.number("to_s", motion.to_s, -kFar, motion.to_s);
    object.finish();
    try {
        check_motion(motion);
    } catch (const InvalidInput& error) {
        fail<InvalidInput>(place.text(), ": ", error.what());
    }
    return motion;
}

SceneObject object_from(const json& value, const JsonPlace& place,
                        const std::filesystem::path& folder, Scene& scene) {
    JsonObject object(value, place);
    SceneObject out;
    out.name = object.text("name", "object");
    out.shape = shape_from(object.get("shape"), object.at("shape"), folder, scene);
    out.motion = motion_from(object.get("motion"), object.at("motion"));
    out.mass_kg = object.number("mass_kg", out.mass_kg, 0.0, 1e9);
    out.drag_n = object.number("drag_n", out.drag_n, 0.0, 1e12);
    if (const json* force = object.find("force_n"))
        out.force_n = triple_of(*force, object.at("force_n"));
    if (const json* colour = object.find("colour")) {
        out.colour = triple_of(*colour, object.at("colour"));
        if (!(std::min({out.colour.x, out.colour.y, out.colour.z}) >= 0.0 &&
              std::max({out.colour.x, out.colour.y, out.colour.z}) <= 1.0))
            fail<InvalidInput>(object.at("colour").text(), " must hold shares in [0, 1]");
    }
    object.finish();
    return out;
}

}  // namespace scree::terrain
