#include "terrain/scene/ground_builder.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/material/map_check.h"
#include "terrain/material/map_files.h"
#include "terrain/scene/ground_noise.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

double ripple(const GroundShape& shape, const glm::dvec2& along) {
    const double bend =
        plane_noise(along.x / (3.0 * shape.length_m), along.y / (5.0 * shape.length_m), shape.seed);
    const double phase = along.x / shape.length_m + 0.6 * bend;
    const double t = phase - std::floor(phase);
    const double lee = 0.3;  // share of a wave that is its steeper side
    const double wave = t < lee ? t / lee : (1.0 - t) / (1.0 - lee);
    return shape.height_m * (wave * wave * (3.0 - 2.0 * wave) - 0.5);
}

// A crescent whose crest runs through its centre: a parabola's rise to the crest, a straight fall
// at the lee slope beyond; both lower towards the horns, which lie further downwind.
double dune(const GroundShape& shape, const glm::dvec2& along) {
    const double half = 0.5 * shape.length_m;
    const double across = along.y / half;
    const double crest = shape.height_m * std::max(0.0, 1.0 - across * across);
    const double x = along.x - 0.35 * half * across * across;
    if (x >= 0.0)
        return std::max(0.0, crest - x * std::tan(shape.slope_deg * kRadians));
    const double rise = std::max(0.0, 1.0 + x / half);
    return crest * rise * rise * (3.0 - 2.0 * rise);
}

double shape_height(const GroundShape& shape, const glm::dvec2& place) {
    const glm::dvec2 away = place - shape.centre_m;
    const double turn = shape.direction_deg * kRadians;
    const glm::dvec2 along(away.x * std::cos(turn) + away.y * std::sin(turn),
                           away.y * std::cos(turn) - away.x * std::sin(turn));
    switch (shape.kind) {
        case GroundShape::Kind::Hills:
            return 0.5 * shape.height_m *
                   fractal_noise(away.x / shape.length_m, away.y / shape.length_m, shape.octaves,
                                 shape.seed);
        case GroundShape::Kind::Ripples:
            return ripple(shape, along);
        case GroundShape::Kind::Pile:
            return std::max(
                0.0, shape.height_m - glm::length(away) * std::tan(shape.slope_deg * kRadians));
        case GroundShape::Kind::Dune:
            return dune(shape, along);
        case GroundShape::Kind::Ramp:
            return along.x * std::tan(shape.slope_deg * kRadians);
        case GroundShape::Kind::Mound:
            return shape.height_m *
                   std::exp(-4.0 * glm::dot(away, away) / (shape.length_m * shape.length_m));
    }
    return 0.0;
}

FloatRaster picture_heights(const Scene& scene) {
    const auto place = std::find_if(scene.files.begin(), scene.files.end(), [&](const auto& file) {
        return file.first == scene.ground.heights;
    });
    const std::string name = place == scene.files.end() ? scene.source : place->second;
    vision::HeightImage picture;
    try {
        picture = vision::read_heights(
            scene.ground.heights,
            {.max_pixels = static_cast<double>(kMaxGroundSide) * kMaxGroundSide});
    } catch (const InvalidInput& error) {
        fail<InvalidInput>(name, ": ", error.what());
    }
    if (std::max(picture.metres.width(), picture.metres.height()) > kMaxGroundSide)
        fail<InvalidInput>(name, ": the picture has ", picture.metres.width(), " x ",
                           picture.metres.height(), " pixels, at most ", kMaxGroundSide,
                           " along a side are allowed");
    const auto scale = static_cast<float>(scene.ground.height_scale);
    for (float& height : picture.metres)
        height *= scale;
    return std::move(picture.metres);
}

bool inside(const MaterialRegion& region, const glm::dvec2& place) {
    if (region.polygon.empty())
        return glm::distance(place, region.centre_m) <= region.radius_m;
    bool odd = false;
    for (std::size_t i = 0, j = region.polygon.size() - 1; i < region.polygon.size(); j = i++) {
        const glm::dvec2& a = region.polygon[i];
        const glm::dvec2& b = region.polygon[j];
        if ((a.y > place.y) != (b.y > place.y) &&
            place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
            odd = !odd;
    }
    return odd;
}

void paint(const Scene& scene, DescriptionMap& map) {
    const double size = map.cell_size;
    parallel_for_each_index(
        0, static_cast<std::size_t>(map.ids.height()), 16, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < map.ids.width(); ++x) {
                const glm::dvec2 centre((x + 0.5) * size, (y + 0.5) * size);
                for (const MaterialRegion& region : scene.regions) {
                    glm::dvec2 place = centre;
                    if (region.ragged_m > 0.0) {
                        const glm::dvec2 at = centre / (2.5 * region.ragged_m);
                        place += region.ragged_m *
                                 glm::dvec2(fractal_noise(at.x, at.y, 5, scene.seed + 101),
                                            fractal_noise(at.x, at.y, 5, scene.seed + 202));
                    }
                    if (inside(region, place))
                        map.ids(x, y) = static_cast<std::uint8_t>(region.material);
                }
            }
        });
}

}  // namespace

Heightfield build_heights(const Scene& scene) {
    Heightfield field;
    field.cell_size = scene.ground.cell_size_m;
    field.heights = scene.ground.heights.empty()
                        ? FloatRaster(scene.ground.width, scene.ground.height)
                        : picture_heights(scene);
    const double size = field.cell_size;
    if (!scene.ground.shapes.empty())
        parallel_for_each_index(
            0, static_cast<std::size_t>(field.heights.height()), 16, [&](std::size_t row) {
                const int y = static_cast<int>(row);
                for (int x = 0; x < field.heights.width(); ++x) {
                    double height = field.heights(x, y);
                    for (const GroundShape& shape : scene.ground.shapes)
                        height += shape_height(shape, {(x + 0.5) * size, (y + 0.5) * size});
                    field.heights(x, y) = static_cast<float>(height);
                }
            });
    check_heightfield(field);
    return field;
}

DescriptionMap build_map(const Scene& scene, const Heightfield& heights) {
    if (!scene.map.empty())
        return read_description_map(scene.map);
    DescriptionMap map;
    map.materials = scene.materials;
    // One soil everywhere needs one cell, not a raster as large as the ground.
    const bool painted = !scene.regions.empty();
    map.cell_size = heights.cell_size *
                    (painted ? 1 : std::max(heights.heights.width(), heights.heights.height()));
    const auto first = static_cast<std::uint8_t>(scene.materials.front().id);
    map.ids = Raster<std::uint8_t>(painted ? heights.heights.width() : 1,
                                   painted ? heights.heights.height() : 1, first);
    paint(scene, map);
    check_map(map, scene.source);
    return map;
}

}  // namespace scree::terrain
