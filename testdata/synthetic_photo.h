#pragma once

#include "base/options.h"
#include "base/raster.h"
#include "vision/outline.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::test {

/// How the rocks lie.
enum class Layout {
    Darts,  ///< Thrown at random: every size, wide gaps where nothing fits.
    Cells,  ///< One to each cell of a jittered honeycomb: tightly packed, crevices of even width.
};
inline constexpr std::string_view kLayoutNames[] = {"darts", "cells"};
constexpr std::span<const std::string_view> names_of(Layout) {
    return kLayoutNames;
}

/// What the made-up photograph shows. Lengths are pixels, strengths 0 (off) to 1 (strong).
struct SyntheticOptions {
    int width = 900;   ///< Of the picture.
    int height = 600;  ///< Of the picture.
    Layout layout = Layout::Darts;
    int n_rocks = 400;               ///< Most rocks to lay; fewer if no room is left.
    double least_diameter = 12;      ///< No rock is smaller before it grows to its neighbours.
    double median_diameter = 40;     ///< Of the log-normal law that diameters are drawn from.
    double greatest_diameter = 110;  ///< No rock is larger before it grows to its neighbours.
    double size_spread = 0.5;        ///< Standard deviation of the logarithm of the diameter.
    double gap = 4;                  ///< Least width between two rocks.
    double growth = 0.25;            ///< Share by which a rock may grow to close gaps.
    double roughness = 0.08;         ///< Deviation of a radius from the mean one, relative.
    double elongation = 0.25;        ///< Deviation from a circle by the second harmonic, at most.
    double light_azimuth = 225;      ///< Degrees, from +x towards +y: where the light comes from.
    double light_elevation = 50;     ///< Degrees above the ground.
    double shadow = 0.6;             ///< Darkness of cast shadows and of the depths of gaps.
    double colour = 0.3;             ///< Spread of brightness and hue between rocks.
    double texture = 0.15;           ///< Smooth variation of brightness over one rock.
    double speckle = 0.0;            ///< Contrast of sharp mineral specks.
    double wetness = 0.0;            ///< Darkened rocks with highlights.
    double matrix = 0.0;             ///< 0: dark deep gaps; 1: gaps full of light sand.
    double grain = 1.0;              ///< Roughness of the ground between rocks.
    double blur = 0.7;               ///< Standard deviation of the lens, px.
    double noise = 0.01;             ///< Standard deviation of the sensor, of full scale.
    double contrast = 1.0;           ///< About middle grey; 1 leaves it.
    bool whole_rocks = false;        ///< Lay no rock that the picture's edge would cut.
    std::uint64_t seed = 1;          ///< Same seed, same bytes.
};

template <class Visitor>
void describe(SyntheticOptions& o, Visitor&& field) {
    constexpr FieldInfo kShare{.min = 0, .max = 1};
    field("width", o.width, {.min = 1, .max = 8192, .unit = "px"});
    field("height", o.height, {.min = 1, .max = 8192, .unit = "px"});
    field("layout", o.layout, {});
    field("n-rocks", o.n_rocks, {.min = 0, .max = 60000});
    field("least-diameter", o.least_diameter, {.min = 4, .max = 2000, .unit = "px"});
    field("median-diameter", o.median_diameter, {.min = 4, .max = 2000, .unit = "px"});
    field("greatest-diameter", o.greatest_diameter, {.min = 4, .max = 2000, .unit = "px"});
    field("size-spread", o.size_spread, {.min = 0, .max = 3});
    field("gap", o.gap, {.min = 0, .max = 100, .unit = "px"});
    field("growth", o.growth, kShare);
    field("roughness", o.roughness, {.min = 0, .max = 0.25});
    field("elongation", o.elongation, {.min = 0, .max = 0.35});
    field("light-azimuth", o.light_azimuth, {.min = -360, .max = 360, .unit = "deg"});
    field("light-elevation", o.light_elevation, {.min = 5, .max = 90, .unit = "deg"});
    field("shadow", o.shadow, kShare);
    field("colour", o.colour, kShare);
    field("texture", o.texture, kShare);
    field("speckle", o.speckle, kShare);
    field("wetness", o.wetness, kShare);
    field("matrix", o.matrix, kShare);
    field("grain", o.grain, kShare);
    field("blur", o.blur, {.min = 0, .max = 20, .unit = "px"});
    field("noise", o.noise, {.min = 0, .max = 0.5});
    field("contrast", o.contrast, {.min = 0, .max = 4});
}

/// A photograph with everything known about it.
struct SyntheticPhoto {
    Photo photo;
    LabelMap labels;                        ///< paint_labels() of the outlines.
    std::vector<vision::Outline> outlines;  ///< Confidence 1; none overlap.
};

/// Lay star-shaped lobed rocks by dart throwing, largest first, and photograph them from above.
///
/// @post   No pixel belongs to two rocks; rocks keep the gap from each other.
/// @throw InvalidOption  a value is outside the range that describe() gives, or the diameters are
///                       not in increasing order.
SyntheticPhoto make_synthetic_photo(const SyntheticOptions& options = {});

}  // namespace scree::test
