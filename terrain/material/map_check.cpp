#include "terrain/material/map_check.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace scree::terrain {
namespace {

constexpr double kMaxSize = 1e6;       // metres
constexpr double kMaxMobility = 16.0;  // as describe(Soil&) says
constexpr double kMaxDiffusion = 4.0;

bool is_plain(const std::string& text) {
    return text.size() <= 1024 && std::none_of(text.begin(), text.end(), [](char c) {
               return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
           });
}

bool is_size(double value) {
    return value > 0.0 && value <= kMaxSize;
}

void check_textures(const Material& material, const std::string& who) {
    const MaterialTextures& textures = material.textures;
    for (const auto* path : {&textures.albedo, &textures.displacement, &textures.normal})
        if (!is_plain(path->string()))
            fail<InvalidInput>(who,
                               " has a texture path that is too long or holds control characters");
    if (!is_size(textures.size_m))
        fail<InvalidInput>(who, " has textures of size ", textures.size_m,
                           " m, must be in (0, 1e6]");
    if (!(textures.displacement_m >= 0.0 && textures.displacement_m <= kMaxSize))
        fail<InvalidInput>(who, " has a displacement height of ", textures.displacement_m,
                           " m, must be in [0, 1e6]");
    if (material.gravel && textures.albedo.empty())
        fail<InvalidInput>(who, " is gravel and has no albedo texture; rocks take theirs from it");
}

void check_hat(const HatShape& hat, const std::string& who) {
    const bool from_neighbours = hat.start == -1.0 && hat.peak == -1.0 && hat.end == -1.0;
    const bool ordered =
        hat.start >= 0.0 && hat.start <= hat.peak && hat.peak <= hat.end && hat.end <= 1.0;
    if (!from_neighbours && !ordered)
        fail<InvalidInput>(who, " has the hat ", hat.start, ", ", hat.peak, ", ", hat.end,
                           "; it must be -1, -1, -1 or 0 <= start <= peak <= end <= 1");
}

void check_soil(const Soil& soil, const std::string& who) {
    try {
        check(soil);
    } catch (const InvalidOption& error) {
        fail<InvalidInput>(who, ": ", error.what());
    }
}

struct PlaneRange {
    const FloatRaster& values;
    std::string_view name;
    double below;  // values must be smaller, or equal if `closed`
    bool closed;
};

void check_plane(const DescriptionMap& map, const PlaneRange& plane, std::string_view source) {
    if (plane.values.empty())
        return;
    if (plane.values.width() != map.ids.width() || plane.values.height() != map.ids.height())
        fail<InvalidInput>(source, ": the plane of ", plane.name, " has ", plane.values.width(),
                           " x ", plane.values.height(), " cells, the ids have ", map.ids.width(),
                           " x ", map.ids.height());
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x) {
            const double value = plane.values(x, y);
            const bool fits =
                value >= 0.0 && (plane.closed ? value <= plane.below : value < plane.below);
            if (!fits)  // NaN too
                fail<InvalidInput>(source, ": cell (", x, ", ", y, ") of id ", int{map.ids(x, y)},
                                   " has a ", plane.name, " of ", value, ", must be in [0, ",
                                   plane.below, plane.closed ? "]" : ")");
        }
}

void check_ids(const DescriptionMap& map, std::string_view source) {
    const std::array<int, 256> slots = slots_of_ids(map.materials);
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x)
            if (slots[map.ids(x, y)] < 0)
                fail<InvalidInput>(source, ": cell (", x, ", ", y, ") has the id ",
                                   int{map.ids(x, y)}, ", which has no material");
}

}  // namespace

void check_map_size(double width, double height, std::string_view source) {
    if (!(width >= 1.0 && height >= 1.0))
        fail<InvalidInput>(source, " has ", width, " x ", height,
                           " cells, at least 1 x 1 are needed");
    if (!(width * height <= kMaxMapCells) || width > 2e9 || height > 2e9)
        fail<InvalidInput>(source, " has ", width, " x ", height, " cells, the limit is ",
                           kMaxMapCells, "; use larger cells");
}

void check_materials(const std::vector<Material>& materials, std::string_view source) {
    if (materials.empty() || materials.size() > kMaxMaterials)
        fail<InvalidInput>(source, " has ", materials.size(), " materials, must have 1 to ",
                           kMaxMaterials);
    std::set<std::string> names;
    int last = -1;
    for (const Material& material : materials) {
        const std::string who =
            std::string(source) + ": the material of id " + std::to_string(material.id);
        if (material.id < 0 || material.id > 255)
            fail<InvalidInput>(who, " is out of range, ids are 0 to 255");
        if (material.id <= last)
            fail<InvalidInput>(who, " follows id ", last, "; ids must be unique and in order");
        last = material.id;
        if (material.name.empty() || !is_plain(material.name))
            fail<InvalidInput>(who, " needs a name of 1 to 1024 bytes without control characters");
        if (!names.insert(material.name).second)
            fail<InvalidInput>(who, " has the name '", material.name, "' of another one");
        check_soil(material.soil, who);
        check_textures(material, who);
        check_hat(material.hat, who);
    }
}

void check_map(const DescriptionMap& map, std::string_view source) {
    check_materials(map.materials, source);
    check_map_size(map.ids.width(), map.ids.height(), source);
    if (!is_size(map.cell_size))
        fail<InvalidInput>(source, " has a cell size of ", map.cell_size,
                           " m, must be in (0, 1e6]");
    check_ids(map, source);
    check_plane(map, {map.repose, "repose", 0.5 * std::numbers::pi, false}, source);
    check_plane(map, {map.mobility, "mobility", kMaxMobility, true}, source);
    check_plane(map, {map.diffusion, "diffusion", kMaxDiffusion, true}, source);
}

std::array<int, 256> slots_of_ids(const std::vector<Material>& materials) {
    std::array<int, 256> slots;
    slots.fill(-1);
    for (std::size_t i = 0; i < materials.size(); ++i)
        slots.at(static_cast<std::size_t>(materials[i].id)) = static_cast<int>(i);
    return slots;
}

glm::u8vec3 material_colour(const Material& material) {
    if (material.colour)
        return *material.colour;
    // Hues a golden section apart, in three steps of brightness: neighbours differ.
    const double hue = std::fmod(0.11 + 0.6180339887 * material.id, 1.0);
    const double value = 0.62 + 0.14 * (material.id % 3);
    const auto channel = [&](double shift) {
        const double around = std::abs(std::fmod(hue + shift, 1.0) * 6.0 - 3.0) - 1.0;
        const double share = 1.0 - 0.5 + 0.5 * std::clamp(around, 0.0, 1.0);
        return static_cast<std::uint8_t>(std::lround(255.0 * value * share));
    };
    return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0)};
}

}  // namespace scree::terrain
