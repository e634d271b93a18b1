#pragma once

#include "base/options.h"
#include "terrain/material/description_map.h"

#include <span>
#include <vector>

namespace scree::terrain {

/// Materials that may mix: the published limit that an id holds one material, lifted as its source
/// proposes (`rocks-and-deformer.md` D.6), by a map a layer.
///
/// Every cell has the same number of layers, the uppermost first; in each, every material has an
/// amount, metres of height. Amounts are double: mixing adds and takes them thousands of times.
struct MaterialLayers {
    double cell_size = 1.0;
    std::vector<Material> materials;                   ///< In order of id.
    std::vector<std::vector<Raster<double>>> amounts;  ///< [layer][place in the table], metres.

    int width() const { return amounts.at(0).at(0).width(); }
    int height() const { return amounts.at(0).at(0).height(); }
};

struct MixOptions {
    int steps = 1;
    double sideways = 0.05;  ///< Share of a difference exchanged with each neighbour in a step.
    double downwards = 0.0;  ///< Share exchanged with the layer below in a step.
};

template <class Visitor>
void describe(MixOptions& o, Visitor&& field) {
    field("mix-steps", o.steps, {.min = 0, .max = 1e6, .help = "steps of mixing"});
    field("mix-sideways", o.sideways,
          {.min = 0, .max = 0.25, .help = "share exchanged with each neighbour in a step"});
    field("mix-downwards", o.downwards,
          {.min = 0, .max = 0.5, .help = "share exchanged with the layer below in a step"});
}

/// What mixing did.
struct MixReport {
    std::vector<double> before_m3;  ///< Volume of every material.
    std::vector<double> after_m3;
};

/// Layers of one thickness each, metres, uppermost first. The uppermost is what the map says; those
/// below are of the materials given by `below`, one id for each (empty: the map's all the way
/// down).
/// @throw InvalidInput  the map breaks check_map(), there is no layer, a thickness is not positive,
///                      `below` has another length or names no material, or they need more than
///                      2e9 amounts.
MaterialLayers layers_of_map(const DescriptionMap& map, std::span<const double> thickness_m,
                             std::span<const int> below = {});

/// Mix neighbouring cells of a layer, then each layer with the one below.
///
/// Two places exchange equal volumes: of material m the share k (f_m - f'_m) of the thinner one,
/// f its fraction. So no cell's thickness changes, no amount becomes negative within the options'
/// bounds, and of every material the sum is kept to rounding. The rim is closed. The same bytes for
/// any number of threads.
/// @throw InvalidOption  a value is out of its range.
/// @throw InvalidInput   there is no layer or rasters differ in size.
MixReport mix_layers(MaterialLayers& layers, const MixOptions& options = {});

/// Volume of every material, cubic metres.
std::vector<double> material_volumes(const MaterialLayers& layers);

/// The map that a deformer sees: of the uppermost `depth_m` metres of every cell, the material with
/// most volume as id (of two equal, the lower) and the soils mixed by volume as planes, the angle
/// of repose by its tangent. Where a cell is empty, its first material.
/// @throw InvalidInput  there is no layer, or the depth is not positive.
DescriptionMap surface_map(const MaterialLayers& layers, double depth_m);

}  // namespace scree::terrain
