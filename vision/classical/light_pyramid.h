#pragma once

#include "base/raster.h"

#include <array>
#include <vector>

namespace scree::vision {

/// One photograph at one scale, brightness and colour freed from the local light.
///
/// Every plane has `kMargin` replicated pixels on all four sides.
struct LightLevel {
    static constexpr int kMargin = 40;
    int width = 0;          ///< Without the margin.
    int height = 0;         ///< Without the margin.
    FloatRaster grey;       ///< (luma - local mean) / local spread.
    FloatRaster red_green;  ///< Red against green, in units of the local spread of the luma.
    FloatRaster yellow_blue;
    FloatRaster luma;    ///< 0..1, gamma coded.
    FloatRaster spread;  ///< Local spread of the luma, with a floor; the unit of the others.
};

inline constexpr int kPyramidLevels = 5;  ///< Each half as wide as the one before.
inline constexpr int kFineLevels = 2;     ///< Levels 0 and 1 exist once, coarser ones in phases.

/// A coarse level made from the next finer one without its first `dx` columns and `dy` rows, with
/// the coarser levels that were made from it.
struct PhasedLevel {
    int dx = 0;
    int dy = 0;
    LightLevel level;
    std::vector<PhasedLevel> coarser;
};

/// A photograph at five scales.
///
/// Halving ties what a level sees to where the picture begins, so levels 2 to 4 are made four
/// times over from each that is finer, shifted by one of its pixels in each direction.
struct LightPyramid {
    std::array<LightLevel, kFineLevels> fine;
    std::vector<PhasedLevel> coarse;  ///< Level 2, four phases.
};

/// Halve a photograph four times and normalise every level by its own surroundings.
///
/// Mean and spread are taken over some 12 pixels of the level itself, never over the whole
/// picture, so a crop changes nothing away from the cut.
/// @throw InvalidInput  the photograph has no pixels.
LightPyramid light_pyramid(const Photo& photo);

}  // namespace scree::vision
