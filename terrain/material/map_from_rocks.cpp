#include "terrain/material/map_from_rocks.h"

#include "base/error.h"
#include "terrain/material/map_check.h"
#include "terrain/material/soil_mix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree::terrain {
namespace {

Material plain_material(int id, const char* name, const Soil& soil, glm::u8vec3 colour) {
    Material material;
    material.id = id;
    material.name = name;
    material.soil = soil;
    material.colour = colour;
    return material;
}

// Mean colours of the pixels without and with a rock.
std::array<glm::u8vec3, 2> mean_colours(const LabelMap& labels, const Photo& photo) {
    std::array<glm::dvec3, 2> sums{};
    std::array<double, 2> counts{};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const std::size_t kind = labels.data()[i] > 0 ? 1 : 0;
        sums[kind] += glm::dvec3(photo.data()[i]);
        counts[kind] += 1.0;
    }
    std::array<glm::u8vec3, 2> colours{glm::u8vec3(150, 130, 100), glm::u8vec3(110, 110, 110)};
    for (std::size_t kind = 0; kind < 2; ++kind)
        if (counts[kind] > 0.0)
            colours[kind] = glm::u8vec3(sums[kind] / counts[kind] + 0.5);
    return colours;
}

// Share of a cell's pixels that belong to rocks.
double rock_share(const LabelMap& labels, int cx, int cy, int edge) {
    const int right = std::min((cx + 1) * edge, labels.width());
    const int bottom = std::min((cy + 1) * edge, labels.height());
    double rocks = 0.0;
    double all = 0.0;
    for (int y = cy * edge; y < bottom; ++y)
        for (int x = cx * edge; x < right; ++x) {
            rocks += labels(x, y) > 0 ? 1.0 : 0.0;
            all += 1.0;
        }
    return rocks / all;
}

void check_pictures(const LabelMap& labels, const Photo& photo, double metres_per_pixel) {
    if (labels.width() != photo.width() || labels.height() != photo.height())
        fail<InvalidInput>("the label map has ", labels.width(), " x ", labels.height(),
                           " pixels, the photograph ", photo.width(), " x ", photo.height(),
                           "; they must be of one picture");
    check_map_size(labels.width(), labels.height(), "the label map");
    if (!(metres_per_pixel > 0.0 && metres_per_pixel <= 1e3))
        fail<InvalidInput>("the photograph's scale is ", metres_per_pixel,
                           " m a pixel, must be in (0, 1000]");
}

}  // namespace

DescriptionMap map_from_rocks(const LabelMap& labels, const Photo& photo, double metres_per_pixel,
                              const RockMapOptions& options) {
    check(options);
    check_pictures(labels, photo, metres_per_pixel);
    const int edge = options.pixels_per_cell;
    const int width = (labels.width() + edge - 1) / edge;
    const int height = (labels.height() + edge - 1) / edge;
    const auto colours = mean_colours(labels, photo);
    DescriptionMap map;
    map.cell_size = metres_per_pixel * edge;
    map.materials = {plain_material(kMatrixId, "matrix", options.matrix, colours[0]),
                     plain_material(kRockId, "rock", options.rock, colours[1])};
    map.ids = Raster<std::uint8_t>(width, height);
    map.repose = FloatRaster(width, height);
    map.mobility = FloatRaster(width, height);
    map.diffusion = FloatRaster(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double share = rock_share(labels, x, y, edge);
            SoilMix mix;
            mix.add(options.matrix, 1.0 - share);
            mix.add(options.rock, share);
            map.ids(x, y) = share >= options.rock_share ? kRockId : kMatrixId;
            map.repose(x, y) = static_cast<float>(mix.repose());
            map.mobility(x, y) = static_cast<float>(mix.mobility());
            map.diffusion(x, y) = static_cast<float>(mix.diffusion());
        }
    check_map(map, "the map of the rocks");
    return map;
}

Photo square_texture(const Photo& photo) {
    const int side = std::min(photo.width(), photo.height());
    const int left = (photo.width() - side) / 2;
    const int top = (photo.height() - side) / 2;
    Photo square(side, side);
    for (int y = 0; y < side; ++y)
        std::copy_n(photo.row(top + y) + left, side, square.row(y));
    return square;
}

}  // namespace scree::terrain
