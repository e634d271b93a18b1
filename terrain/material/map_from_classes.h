#pragma once

#include "base/options.h"
#include "terrain/material/description_map.h"
#include "vision/classify/ground_classes.h"

namespace scree::terrain {

/// How the classified pixels of a photograph become a map.
struct ClassMapOptions {
    int pixels_per_cell = 8;  ///< Edge of a map cell, pixels of the photograph.
};

template <class Visitor>
void describe(ClassMapOptions& o, Visitor&& field) {
    field("pixels-per-cell", o.pixels_per_cell,
          {.min = 1, .max = 4096, .unit = "px", .help = "edge of a map cell in the photograph"});
}

/// Soil, name and colour of a class of ground; its id is the class's number. Sand, mud and pebbles
/// are the presets; rock hardly moves, grass holds a steep slope and little is pushed.
Material material_of(vision::GroundClass kind);

/// A map from the classes of a photograph (vision/classify): a cell takes the class of most of its
/// pixels, of two as frequent the one of lower number. The table holds all classes, without
/// textures. A last column or row of cells may reach beyond the picture.
/// @param classes           Values are vision::GroundClass.
/// @param metres_per_pixel  Scale of the photograph.
/// @throw InvalidInput   the picture is empty, the scale not positive, a value no class.
/// @throw InvalidOption  a value is out of its range.
DescriptionMap map_from_classes(const Raster<std::uint8_t>& classes, double metres_per_pixel,
                                const ClassMapOptions& options = {});

}  // namespace scree::terrain
