#pragma once

#include "vision/rock_data.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::vision {

struct GrainSizeOptions {
    bool count_cut_rocks = true;  ///< Count rocks that the picture's border cuts.
    double min_diameter_px = 0;   ///< Leave out rocks with a smaller equivalent diameter, px.
};

template <class Visitor>
void describe(GrainSizeOptions& o, Visitor&& field) {
    field("count-cut-rocks", o.count_cut_rocks,
          {.min = 0, .max = 1, .help = "count rocks that the picture's border cuts"});
    field("min-diameter", o.min_diameter_px,
          {.min = 0, .max = 1e6, .unit = "px", .help = "smallest rock of the curve"});
}

/// One rock of the curve.
struct Grain {
    std::size_t rock = 0;          ///< Index in the set.
    double diameter_px = 0.0;      ///< Of the disc of equal area.
    double area_px = 0.0;          ///< Square pixels.
    double finer_by_number = 0.0;  ///< Share of the rocks that are at most this large, 0 to 1.
    double finer_by_area = 0.0;    ///< Their share of the area all rocks cover, 0 to 1.
    bool cut = false;              ///< The picture's border cuts it, so it is larger than this.
};

/// Diameters that 16, 50 and 84 percent are finer than, in the unit of the curve.
struct GrainPercentiles {
    double d16 = 0.0;
    double d50 = 0.0;
    double d84 = 0.0;
};

/// Cumulative grain-size curve.
struct GrainSizeCurve {
    std::vector<Grain> grains;        ///< By increasing diameter, ties by index.
    GrainPercentiles by_number;       ///< Ranks interpolated linearly, as percentile() does.
    GrainPercentiles by_area;         ///< Interpolated between the middles of the rocks' shares.
    double millimetres_per_px = 0.0;  ///< 0 if the scale is unknown.
    /// Of the percentiles: "mm" if the scale is known, else "px".
    std::string unit() const { return millimetres_per_px > 0.0 ? "mm" : "px"; }
};

/// Measure the rocks of a photograph. Without any, the percentiles are 0.
/// @throw InvalidOption
GrainSizeCurve grain_size_curve(const RockSet& set, const GrainSizeOptions& options = {});

/// The curve as comma-separated text: the percentiles in lines that start with `#`, a line of
/// column names, then a line a rock.
std::string sizes_to_csv(const GrainSizeCurve& curve);

/// @throw IoError
void write_sizes_csv(const std::filesystem::path& path, const GrainSizeCurve& curve);

}  // namespace scree::vision
