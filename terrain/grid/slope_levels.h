#pragma once

#include "terrain/grid/slope_limits.h"

#include <vector>

namespace scree::terrain {

/// A ground and the same ground with cells of twice, four times ... the size.
///
/// A coarse height is the mean of its four; a coarse limit is the mean over the paths that it
/// stands for, so that ground at rest is at rest on every level. An odd last column or row has no
/// coarse cell.
class SlopeLevels {
public:
    SlopeLevels(DoubleRaster heights, SlopeLimits limits);

    /// One V-cycle: `sweeps` passes on each level on the way up to coarser cells and as many on the
    /// way back. The sum of the heights is kept to rounding.
    /// @param relaxation  In (0, 2): how much of a face's excess a pass moves; 1 is all of it.
    void cycle(int sweeps, double relaxation);

    const DoubleRaster& heights() const { return levels_.front().heights; }
    const SlopeLimits& limits() const { return levels_.front().limits; }
    /// Passes so far, a pass over a coarse level counted by its cells.
    double passes() const { return passes_; }

private:
    struct Level {
        DoubleRaster heights;
        DoubleRaster correction;  ///< Heights before a visit, then what the visit changed.
        SlopeLimits limits;
    };

    void visit(std::size_t level, int sweeps, double relaxation);
    void count(const Level& level, double passes);

    std::vector<Level> levels_;
    double passes_ = 0.0;
};

}  // namespace scree::terrain
