#pragma once

#include "base/random.h"
#include "terrain/grid/deformer.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace scree::test {

/// Random heights in [0, top) on a slope along x, metres.
inline terrain::Heightfield rough_ground(int width, int height, double top, std::uint64_t seed,
                                         double slope = 0.0, double cell_size = 1.0) {
    Rng rng({.seed = seed});
    terrain::Heightfield ground{FloatRaster(width, height), cell_size};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            ground.heights(x, y) = static_cast<float>(top * rng.uniform() + slope * x * cell_size);
    return ground;
}

inline terrain::Heightfield flat_ground(int width, int height, double cell_size = 1.0) {
    return {FloatRaster(width, height), cell_size};
}

/// A round cone in the middle.
inline terrain::Heightfield cone(int size, double radius, double slope, double cell_size = 1.0) {
    terrain::Heightfield ground = flat_ground(size, size, cell_size);
    const double middle = (size - 1) / 2.0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            ground.heights(x, y) = static_cast<float>(
                cell_size * slope * std::max(0.0, radius - std::hypot(x - middle, y - middle)));
    return ground;
}

/// A ball at (cx, cy) cells, its lowest point at `lowest` metres, which pushes along +x with
/// `drag` and outwards with `spread`, in grid units.
inline terrain::Load ball(double cx, double cy, double radius, double lowest, float drag,
                          float spread, double cell_size = 1.0) {
    const int reach = static_cast<int>(std::ceil(radius)) + 1;
    terrain::Load load;
    load.window = {static_cast<int>(cx) - reach, static_cast<int>(cy) - reach, 2 * reach + 1,
                   2 * reach + 1};
    load.force_x = FloatRaster(load.window.width, load.window.height);
    load.force_z = load.force_x;
    load.underside =
        FloatRaster(load.window.width, load.window.height, std::numeric_limits<float>::infinity());
    for (int y = 0; y < load.window.height; ++y)
        for (int x = 0; x < load.window.width; ++x) {
            const double dx = load.window.x + x - cx;
            const double dy = load.window.y + y - cy;
            const double distance = std::hypot(dx, dy);
            if (distance > radius)
                continue;
            const double away = distance > 0 ? spread / distance : 0.0;
            load.force_x(x, y) = static_cast<float>(drag + away * dx);
            load.force_z(x, y) = static_cast<float>(away * dy);
            load.underside(x, y) = static_cast<float>(
                lowest + cell_size * (radius - std::sqrt(radius * radius - distance * distance)));
        }
    return load;
}

/// Three soils in stripes and patches over a grid of cells of 1 m, parameters by the cell.
inline terrain::DescriptionMap patchwork(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 1});
    terrain::DescriptionMap map;
    for (const terrain::Soil& soil : {terrain::kSand, terrain::kMud, terrain::kPebbles}) {
        terrain::Material material;
        material.id = static_cast<int>(map.materials.size());
        material.name = "soil";
        material.soil = soil;
        map.materials.push_back(material);
    }
    map.materials[1].soil.compaction = 0.3;
    map.ids = Raster<std::uint8_t>(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            map.ids(x, y) = static_cast<std::uint8_t>(
                rng.below(5) == 0 ? rng.below(3) : static_cast<std::uint64_t>(x * 3 / width));
    return map;
}

inline terrain::SoilTile soil_of(const terrain::SoilField& field,
                                 const terrain::Heightfield& ground) {
    terrain::SoilTile tile;
    field.fill({0, 0, ground.heights.width(), ground.heights.height()}, tile);
    return tile;
}

inline FloatRaster zeros_like(const terrain::Heightfield& ground) {
    return FloatRaster(ground.heights.width(), ground.heights.height());
}

inline double sum_of(const FloatRaster& raster) {
    double sum = 0.0;
    for (const float value : raster)
        sum += double{value};
    return sum;
}

}  // namespace scree::test
