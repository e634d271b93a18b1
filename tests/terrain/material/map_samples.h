#pragma once

#include "base/random.h"
#include "terrain/material/description_map.h"

#include <cmath>
#include <numbers>

namespace scree::test {

/// Sand, mud and pebbles as ids 0, 3 and 7.
inline std::vector<terrain::Material> three_materials() {
    using namespace terrain;
    std::vector<Material> materials(3);
    materials[0] = {
        .id = 0, .name = "sand", .soil = kSand, .textures = {}, .hat = {}, .colour = {}};
    materials[1] = {
        .id = 3, .name = "wet mud", .soil = kMud, .textures = {}, .hat = {}, .colour = {}};
    materials[2] = {
        .id = 7, .name = "pebbles", .soil = kPebbles, .textures = {}, .hat = {}, .colour = {}};
    return materials;
}

/// A map of the three at random, with or without planes.
inline terrain::DescriptionMap random_map(int width, int height, std::uint64_t seed,
                                          bool with_planes = true) {
    Rng rng({.seed = seed});
    terrain::DescriptionMap map;
    map.materials = three_materials();
    map.cell_size = 0.25;
    map.ids = Raster<std::uint8_t>(width, height);
    for (std::uint8_t& id : map.ids)
        id = static_cast<std::uint8_t>(map.materials[rng.below(3)].id);
    if (!with_planes)
        return map;
    const auto fill = [&](FloatRaster& plane, double high) {
        plane = FloatRaster(width, height);
        for (float& value : plane)
            value = static_cast<float>(rng.uniform(0.0, high));
    };
    fill(map.repose, 0.98 * std::numbers::pi / 2.0);
    fill(map.mobility, 1.0);
    fill(map.diffusion, 1.0);
    return map;
}

/// Same cells, table and cell size.
inline bool same_map(const terrain::DescriptionMap& a, const terrain::DescriptionMap& b) {
    return a.ids == b.ids && a.repose == b.repose && a.mobility == b.mobility &&
           a.diffusion == b.diffusion && a.cell_size == b.cell_size && a.materials == b.materials;
}

}  // namespace scree::test
