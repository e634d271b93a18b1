#pragma once

#include "base/options.h"
#include "terrain/material/description_map.h"

#include <filesystem>
#include <vector>

namespace scree::terrain {

/// How painted colours become materials.
struct PaintOptions {
    double tolerance = 24.0;  ///< Farthest a painted colour may be from a material's, steps of 255.
};

template <class Visitor>
void describe(PaintOptions& o, Visitor&& field) {
    field("colour-tolerance", o.tolerance,
          {.min = 0, .max = 442, .help = "farthest a painted colour may be from a material's"});
}

/// A map from a painted picture of ids.
/// @throw InvalidInput  an id has no material; names the cell.
DescriptionMap map_from_ids(Raster<std::uint8_t> ids, const std::vector<Material>& materials,
                            double cell_size);

/// A map from a picture painted in the materials' own colours; every pixel takes the nearest (of
/// two as near, the one of lower id).
/// @throw InvalidInput  no material has a colour, or a pixel is farther than the tolerance from
///                      all; names the pixel, its colour and the nearest material.
DescriptionMap map_from_colours(const Photo& painted, const std::vector<Material>& materials,
                                double cell_size, const PaintOptions& options = {});

/// Read a painted picture: ids if it has one channel, else colours. @throw IoError, InvalidInput
DescriptionMap read_painted_map(const std::filesystem::path& path,
                                const std::vector<Material>& materials, double cell_size,
                                const PaintOptions& options = {});

}  // namespace scree::terrain
