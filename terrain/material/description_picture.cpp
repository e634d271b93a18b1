#include "terrain/material/description_picture.h"

#include "terrain/material/map_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

constexpr int kMaxScale = 64;
constexpr int kNear = 60;      // sum of the differences of channels
constexpr double kEdge = 0.7;  // brightness of edges between materials

std::uint8_t scaled(std::uint8_t value, double factor) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value * factor), 0L, 255L));
}

glm::u8vec3 scaled(glm::u8vec3 colour, double factor) {
    return {scaled(colour.x, factor), scaled(colour.y, factor), scaled(colour.z, factor)};
}

// Friction against that of the material, within bounds that leave the colour recognisable.
double brightness(const DescriptionMap& map, const Material& material, int x, int y) {
    if (map.repose.empty())
        return 1.0;
    const double own = std::tan(glm::radians(material.soil.repose_deg));
    const double here = std::tan(double{map.repose(x, y)});
    return std::clamp(own > 0.0 ? here / own : 1.0, 0.7, 1.3);
}

bool differs(const DescriptionMap& map, int x, int y, int u, int v) {
    return map.ids.contains(u, v) && map.ids(u, v) != map.ids(x, y);
}

// A cell's square; its upper and left sides are dark where another material begins.
void draw_cell(const DescriptionMap& map, int x, int y, glm::u8vec3 colour, int scale,
               Photo& picture) {
    const int line = std::max(1, scale / 12);
    const bool left = scale > 2 && differs(map, x, y, x - 1, y);
    const bool top = scale > 2 && differs(map, x, y, x, y - 1);
    for (int v = 0; v < scale; ++v)
        for (int u = 0; u < scale; ++u) {
            const bool edge = (left && u < line) || (top && v < line);
            picture(x * scale + u, y * scale + v) = edge ? scaled(colour, kEdge) : colour;
        }
}

bool is_near(glm::u8vec3 a, const std::vector<glm::u8vec3>& others) {
    return std::any_of(others.begin(), others.end(), [a](glm::u8vec3 b) {
        const glm::ivec3 d = glm::abs(glm::ivec3(a) - glm::ivec3(b));
        return d.x + d.y + d.z < kNear;
    });
}

}  // namespace

std::vector<glm::u8vec3> legend_colours(const std::vector<Material>& materials) {
    std::vector<glm::u8vec3> colours;
    for (const Material& material : materials) {
        glm::u8vec3 colour = material_colour(material);
        Material other;
        other.id = material.id;
        for (int tries = 0; tries < 16 && is_near(colour, colours); ++tries, ++other.id)
            colour = material_colour(other);
        colours.push_back(colour);
    }
    return colours;
}

Photo description_picture(const DescriptionMap& map, int least_size) {
    check_map(map, "the map to show");
    const int longer = std::max(map.ids.width(), map.ids.height());
    const int scale = std::clamp((least_size + longer - 1) / longer, 1, kMaxScale);
    const std::array<int, 256> slots = slots_of_ids(map.materials);
    const std::vector<glm::u8vec3> legend = legend_colours(map.materials);
    Photo picture(map.ids.width() * scale, map.ids.height() * scale);
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x) {
            const auto slot = static_cast<std::size_t>(slots[map.ids(x, y)]);
            const Material& material = map.materials[slot];
            const glm::u8vec3 colour = scaled(legend[slot], brightness(map, material, x, y));
            draw_cell(map, x, y, colour, scale, picture);
        }
    return picture;
}

Raster<std::uint8_t> channel_picture(const DescriptionMap& map, MapChannel channel) {
    check_map(map, "the map to show");
    const std::array<int, 256> slots = slots_of_ids(map.materials);
    const auto value = [&](std::size_t cell) {
        const Soil& soil =
            map.materials[static_cast<std::size_t>(slots[map.ids.data()[cell]])].soil;
        const auto own = [cell](const FloatRaster& plane, double otherwise) {
            return plane.empty() ? otherwise : double{plane.data()[cell]};
        };
        if (channel == MapChannel::Repose)
            return own(map.repose, glm::radians(soil.repose_deg));
        return channel == MapChannel::Mobility ? own(map.mobility, soil.mobility)
                                               : own(map.diffusion, soil.diffusion);
    };
    double white = channel == MapChannel::Repose ? glm::radians(90.0) : 0.0;
    for (std::size_t i = 0; i < map.ids.size(); ++i)
        white = std::max(white, value(i));
    Raster<std::uint8_t> picture(map.ids.width(), map.ids.height());
    for (std::size_t i = 0; i < picture.size() && white > 0.0; ++i)
        picture.data()[i] = static_cast<std::uint8_t>(std::lround(255.0 * value(i) / white));
    return picture;
}

std::vector<double> material_shares(const DescriptionMap& map) {
    std::array<double, 256> counts{};
    for (const std::uint8_t id : map.ids)
        counts[id] += 1.0;
    std::vector<double> shares;
    for (const Material& material : map.materials)
        shares.push_back(counts.at(static_cast<std::size_t>(material.id)) /
                         static_cast<double>(std::max<std::size_t>(1, map.ids.size())));
    return shares;
}

}  // namespace scree::terrain
