#pragma once

#include "terrain/material/description_map.h"

#include <span>
#include <vector>

namespace scree::terrain {

/// The hat function (`rocks-and-deformer.md` eq. 4.15): rises from `a` to one at `b`, falls to `c`.
/// Where `a` is `b`, or `b` is `c`, that side is a step.
/// @pre  a <= b <= c.
double hat(double a, double b, double c, double t);

/// Start, peak and end of a material's hat over the normalised id.
struct HatBreaks {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    bool first = false;  ///< Below its peak there is nothing else: it stays one.
    bool last = false;   ///< Likewise above.
};

/// Hats of a table, in its order: the material's own shape, else peak id / 255 and the peaks of the
/// neighbours in the table as start and end; the first and the last are one-sided.
std::vector<HatBreaks> hat_breaks(const std::vector<Material>& materials);

/// Share of every material at the normalised id `t`; they add up to one. Where no hat reaches, the
/// material of the nearest peak has it all.
/// @pre  `weights` is as long as `breaks`.
void hat_weights(std::span<const HatBreaks> breaks, double t, std::span<double> weights);

/// The id interpolated between the centres of the four nearest cells, over 255: what a filtering
/// look-up would give. Valid only between materials that are neighbours in the table: on its way
/// from id 0 to id 2 it passes through id 1.
/// @param x, y  In cells; cell (0, 0) has its centre at (0.5, 0.5). The rim is carried outwards.
double filtered_id(const Raster<std::uint8_t>& ids, double x, double y);

}  // namespace scree::terrain
