#include "terrain/material/map_from_ids.h"

#include "base/error.h"
#include "terrain/material/map_check.h"
#include "terrain/material/map_files.h"
#include "vision/image_io.h"

#include <cmath>
#include <unordered_map>

namespace scree::terrain {
namespace {

int squared_distance(glm::u8vec3 a, glm::u8vec3 b) {
    const glm::ivec3 d = glm::ivec3(a) - glm::ivec3(b);
    return d.x * d.x + d.y * d.y + d.z * d.z;
}

const Material* nearest_material(glm::u8vec3 colour, const std::vector<Material>& materials) {
    const Material* nearest = nullptr;
    for (const Material& material : materials)
        if (material.colour &&
            (nearest == nullptr || squared_distance(colour, *material.colour) <
                                       squared_distance(colour, *nearest->colour)))
            nearest = &material;
    return nearest;
}

std::uint32_t key_of(glm::u8vec3 c) {
    return (std::uint32_t{c.x} << 16) | (std::uint32_t{c.y} << 8) | c.z;
}

}  // namespace

DescriptionMap map_from_ids(Raster<std::uint8_t> ids, const std::vector<Material>& materials,
                            double cell_size) {
    DescriptionMap map;
    map.ids = std::move(ids);
    map.materials = materials;
    map.cell_size = cell_size;
    check_map(map, "the painted picture");
    return map;
}

DescriptionMap map_from_colours(const Photo& painted, const std::vector<Material>& materials,
                                double cell_size, const PaintOptions& options) {
    check(options);
    check_materials(materials, "the table of materials");
    check_map_size(painted.width(), painted.height(), "the painted picture");
    if (nearest_material({}, materials) == nullptr)
        fail<InvalidInput>("no material has a colour to be painted with; give some in the table");
    Raster<std::uint8_t> ids(painted.width(), painted.height());
    std::unordered_map<std::uint32_t, std::uint8_t> known;  // painted pictures have few colours
    for (int y = 0; y < ids.height(); ++y)
        for (int x = 0; x < ids.width(); ++x) {
            const glm::u8vec3 colour = painted(x, y);
            const auto found = known.find(key_of(colour));
            if (found != known.end()) {
                ids(x, y) = found->second;
                continue;
            }
            const Material& material = *nearest_material(colour, materials);
            const double distance = std::sqrt(squared_distance(colour, *material.colour));
            if (!(distance <= options.tolerance))
                fail<InvalidInput>("the painted picture: pixel (", x, ", ", y, ") has the colour ",
                                   int{colour.x}, ", ", int{colour.y}, ", ", int{colour.z},
                                   ", which is ", distance, " from that of '", material.name,
                                   "', the nearest; at most ", options.tolerance, " is allowed");
            ids(x, y) = static_cast<std::uint8_t>(material.id);
            known.emplace(key_of(colour), ids(x, y));
        }
    return map_from_ids(std::move(ids), materials, cell_size);
}

DescriptionMap read_painted_map(const std::filesystem::path& path,
                                const std::vector<Material>& materials, double cell_size,
                                const PaintOptions& options) {
    if (vision::count_channels(path, {.max_pixels = kMaxMapCells}) == 1)
        return map_from_ids(read_ids(path), materials, cell_size);
    const auto painted = vision::read_photo(path, {.max_pixels = kMaxMapCells});
    return map_from_colours(painted.pixels, materials, cell_size, options);
}

}  // namespace scree::terrain
