#pragma once

#include "terrain/grid/deformer.h"
#include "terrain/grid/literal_step.h"

#include <cstddef>
#include <span>

namespace scree::terrain {

/// The published scheme over the whole grid: every cell of every iteration, base and displacement
/// as one height. Gives the bytes of literal_step().
class LiteralGround {
public:
    LiteralGround(const Heightfield& base, const SoilField& soil, const DeformerOptions& options);

    /// One frame.
    /// @param moved  If given: upper bound of what a cell moved in the frame, metres.
    DeformerReport step(std::span<const Load> loads, float* moved = nullptr);

    void read_displacement(const CellWindow& window, FloatRaster& out) const;
    /// Sum of the displacements.
    double sum() const;
    std::size_t bytes() const;

private:
    void gather(std::span<const Load> loads);
    void iterate();
    void step_row(int y);
    void refresh_rim(FloatRaster& heights) const;

    const Heightfield* base_;
    LiteralRule rule_;
    int iterations_;
    int width_, height_;
    bool uniform_;
    bool loaded_ = false;
    // All rasters have one cell more on every side than the grid.
    SoilTile soil_;  ///< One cell where the soil is the same everywhere.
    FloatRaster heights_, next_;
    FloatRaster force_x_, force_z_;  ///< Empty until the first load.
};

}  // namespace scree::terrain
