#pragma once

#include "base/options.h"
#include "base/raster.h"

#include <cstdint>

namespace scree::vision {

/// How a picture is cut into small pieces of one colour.
struct SuperpixelOptions {
    int size_px = 12;         ///< Edge of the squares that they start as.
    double compactness = 12;  ///< Colour difference that weighs as much as one edge length.
    int rounds = 8;           ///< Of assigning pixels and moving centres.
};

template <class Visitor>
void describe(SuperpixelOptions& o, Visitor&& field) {
    field("superpixel-size", o.size_px,
          {.min = 4, .max = 256, .unit = "px", .help = "edge of a small piece of one colour"});
    field("compactness", o.compactness,
          {.min = 0.1, .max = 100, .help = "how square the small pieces stay"});
    field("superpixel-rounds", o.rounds, {.min = 1, .max = 50, .help = "rounds of moving centres"});
}

/// Pieces of a picture, each connected.
struct Superpixels {
    Raster<std::int32_t> ids;  ///< 0 to count - 1.
    int count = 0;
};

/// Simple linear iterative clustering (Achanta et al. 2012) in CIE L*a*b*.
///
/// Every pixel takes the nearest of the nine centres round its square, so the picture's size bounds
/// the work; pieces that came apart are joined to a neighbour.
/// @param lab  L* in 0 to 100.
/// @throw InvalidOption  a value is out of range.
Superpixels superpixels(const Raster<glm::vec3>& lab, const SuperpixelOptions& options = {});

/// CIE L*a*b* of a photograph, D65.
Raster<glm::vec3> lab_of(const Photo& photo);

}  // namespace scree::vision
