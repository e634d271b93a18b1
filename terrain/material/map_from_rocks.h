#pragma once

#include "base/options.h"
#include "terrain/material/description_map.h"

namespace scree::terrain {

/// How rocks found in a photograph become a map.
struct RockMapOptions {
    int pixels_per_cell = 8;  ///< Edge of a map cell, pixels of the photograph.
    double rock_share = 0.5;  ///< Least share of a cell that rocks cover to make it rock.
    Soil rock = kPebbles;
    Soil matrix = kSand;
};

template <class Visitor>
void describe(RockMapOptions& o, Visitor&& field) {
    field("pixels-per-cell", o.pixels_per_cell,
          {.min = 1, .max = 4096, .unit = "px", .help = "edge of a map cell in the photograph"});
    field("rock-share", o.rock_share,
          {.min = 0.01, .max = 1, .help = "share of a cell that rocks must cover to make it rock"});
}

inline constexpr int kMatrixId = 0;
inline constexpr int kRockId = 1;

/// Rock (id 1) and the matrix between (id 0), from the label map of `scree rocks`, where 0 is no
/// rock.
///
/// The parameters of a cell are the two soils' mixed by the share that rocks cover, the angle of
/// repose by its tangent. Both colours are the photograph's mean over the pixels of each kind.
/// Textures are left to the caller. A last column or row of cells may reach beyond the picture.
/// @param metres_per_pixel  Scale of the photograph.
/// @throw InvalidInput   the pictures' sizes differ, are nothing, or the scale is not positive.
/// @throw InvalidOption  a value is out of its range.
DescriptionMap map_from_rocks(const LabelMap& labels, const Photo& photo, double metres_per_pixel,
                              const RockMapOptions& options = {});

/// The largest square about the middle of a photograph: a texture whose repetitions are not
/// stretched.
Photo square_texture(const Photo& photo);

}  // namespace scree::terrain
