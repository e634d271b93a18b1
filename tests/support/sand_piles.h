#pragma once

#include "base/raster.h"
#include "terrain/grid/heightfield.h"
#include "terrain/grid/soil_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace scree::test {

/// A cone in the middle of a square of cells, `slope` high per cell size.
inline FloatRaster cone(int side, double radius_cells, double slope, double cell_size = 1.0) {
    FloatRaster heights(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double distance = std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side);
            heights(x, y) =
                static_cast<float>(cell_size * slope * std::max(0.0, radius_cells - distance));
        }
    return heights;
}

/// Two soils side by side; the right half begins at column side / 2. Degrees of repose.
inline terrain::SoilTile two_soils(int side, double left_deg, double right_deg,
                                   float diffusion = 0.25F) {
    terrain::SoilTile soil;
    soil.repose = FloatRaster(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            soil.repose(x, y) = static_cast<float>((x < side / 2 ? left_deg : right_deg) *
                                                   std::numbers::pi / 180.0);
    soil.tan_repose = soil.repose;
    for (float& tangent : soil.tan_repose)
        tangent = std::tan(tangent);
    soil.mobility = FloatRaster(side, side, 0.5F);
    soil.diffusion = FloatRaster(side, side, diffusion);
    soil.compaction = FloatRaster(side, side);
    return soil;
}

/// Heights of any size up to `amplitude`, cell by cell.
inline FloatRaster rough_heights(int width, int height, float amplitude, unsigned seed) {
    std::mt19937 random(seed);
    FloatRaster heights(width, height);
    for (float& value : heights)
        value = amplitude * static_cast<float>(random()) / 4294967296.0F;
    return heights;
}

inline double sum_of(const FloatRaster& values) {
    double sum = 0.0;
    for (const float value : values)
        sum += static_cast<double>(value);
    return sum;
}

/// Greatest angle of a face above the repose of its higher cell, degrees; negative below it.
inline double steepest_over_deg(const FloatRaster& heights, const terrain::SoilTile& soil,
                                double cell_size) {
    double worst = -90.0;
    const auto face = [&](int ax, int ay, int bx, int by) {
        const double difference =
            static_cast<double>(heights(bx, by)) - static_cast<double>(heights(ax, ay));
        const double repose =
            static_cast<double>(difference > 0.0 ? soil.repose(bx, by) : soil.repose(ax, ay));
        worst = std::max(worst, (std::atan(std::abs(difference) / cell_size) - repose) * 180.0 /
                                    std::numbers::pi);
    };
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x) {
            if (x + 1 < heights.width())
                face(x, y, x + 1, y);
            if (y + 1 < heights.height())
                face(x, y, x, y + 1);
        }
    return worst;
}

}  // namespace scree::test
