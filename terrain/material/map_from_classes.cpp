#include "terrain/material/map_from_classes.h"

#include "base/error.h"
#include "terrain/material/map_check.h"

#include <algorithm>
#include <array>

namespace scree::terrain {
namespace {

using vision::GroundClass;
using vision::kGroundClasses;

constexpr Soil kRockSoil{.repose_deg = 80.0, .mobility = 0.02, .diffusion = 0.01};
constexpr Soil kGrassSoil{.repose_deg = 50.0, .mobility = 0.08, .diffusion = 0.03};

std::uint8_t most_frequent(const Raster<std::uint8_t>& classes, int cx, int cy, int edge) {
    std::array<int, kGroundClasses> counts{};
    const int right = std::min((cx + 1) * edge, classes.width());
    const int bottom = std::min((cy + 1) * edge, classes.height());
    for (int y = cy * edge; y < bottom; ++y)
        for (int x = cx * edge; x < right; ++x)
            ++counts[classes(x, y)];
    return static_cast<std::uint8_t>(
        std::distance(counts.begin(), std::max_element(counts.begin(), counts.end())));
}

}  // namespace

Material material_of(GroundClass kind) {
    constexpr std::array<Soil, kGroundClasses> kSoils = {kSand, kMud, kPebbles, kRockSoil,
                                                         kGrassSoil};
    constexpr std::array<glm::u8vec3, kGroundClasses> kColours = {
        glm::u8vec3(206, 182, 138), glm::u8vec3(104, 82, 60), glm::u8vec3(142, 142, 146),
        glm::u8vec3(112, 106, 102), glm::u8vec3(96, 130, 62)};
    const auto index = static_cast<std::size_t>(kind);
    Material material;
    material.id = static_cast<int>(index);
    material.name = vision::kGroundClassNames[index];
    material.soil = kSoils[index];
    material.colour = kColours[index];
    return material;
}

DescriptionMap map_from_classes(const Raster<std::uint8_t>& classes, double metres_per_pixel,
                                const ClassMapOptions& options) {
    check(options);
    check_map_size(classes.width(), classes.height(), "the picture of classes");
    if (!(metres_per_pixel > 0.0 && metres_per_pixel <= 1e3))
        fail<InvalidInput>("the photograph's scale is ", metres_per_pixel,
                           " m/px, must be above 0 and at most 1000");
    for (int y = 0; y < classes.height(); ++y)
        for (int x = 0; x < classes.width(); ++x)
            if (classes(x, y) >= kGroundClasses)
                fail<InvalidInput>("pixel (", x, ", ", y, ") holds class ",
                                   static_cast<int>(classes(x, y)), ", classes are 0 to ",
                                   kGroundClasses - 1);
    const int edge = options.pixels_per_cell;
    DescriptionMap map;
    map.cell_size = metres_per_pixel * edge;
    map.ids = Raster<std::uint8_t>((classes.width() + edge - 1) / edge,
                                   (classes.height() + edge - 1) / edge);
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x)
            map.ids(x, y) = most_frequent(classes, x, y, edge);
    for (std::size_t kind = 0; kind < kGroundClasses; ++kind)
        map.materials.push_back(material_of(static_cast<GroundClass>(kind)));
    return map;
}

}  // namespace scree::terrain
