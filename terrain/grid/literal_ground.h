#pragma once

#include "terrain/grid/deformer.h"
#include "terrain/grid/literal_step.h"
#include "terrain/grid/tile_store.h"

#include <cstddef>
#include <span>

namespace scree::terrain {

/// Rows that begin on the boundary of a cache line, with a row more at either end and room for a
/// cell more at either side.
class RimmedRows {
public:
    RimmedRows(int width, int height)
        : stride_(stride_of(width)), values_(make_block(size(width, height))) {}

    /// @param y  From -1 to the height.
    float* row(int y) { return values_.get() + (y + 1) * stride_ + kSide; }
    const float* row(int y) const { return values_.get() + (y + 1) * stride_ + kSide; }

    /// Floats that it takes.
    static std::size_t size(int width, int height) {
        return static_cast<std::size_t>(stride_of(width)) * (static_cast<std::size_t>(height) + 2);
    }

private:
    static constexpr std::ptrdiff_t kSide = 16;
    static std::ptrdiff_t stride_of(int width) { return (width + 2 * kSide + 15) / 16 * 16; }

    std::ptrdiff_t stride_;
    FloatBlock values_;
};

/// The published scheme over the whole grid: every cell of every iteration, base and displacement
/// as one height. Gives the bytes of literal_step().
class LiteralGround {
public:
    LiteralGround(const Heightfield& base, const SoilField& soil, const DeformerOptions& options);

    /// One frame.
    /// @param moved  If given: upper bound of what a cell moved in the frame, metres.
    DeformerReport step(std::span<const Load> loads, float* moved = nullptr);

    /// New displacements for the whole ground.
    void replace(const FloatRaster& displacement);

    void read_displacement(const CellWindow& window, FloatRaster& out) const;
    /// Sum of the displacements.
    double sum() const;
    std::size_t bytes() const;

private:
    void gather(std::span<const Load> loads);
    void iterate();
    void step_row(int y);
    void step_cells(int y);
    void copy_rim_rows(RimmedRows& heights) const;

    const Heightfield* base_;
    LiteralRule rule_;
    int iterations_;
    int width_, height_;
    bool uniform_;
    bool loaded_ = false;
    RimmedRows heights_, next_;
    // These rasters have one cell more on every side than the grid.
    SoilTile soil_;                  ///< One cell where the soil is the same everywhere.
    FloatRaster force_x_, force_z_;  ///< Empty until the first load.
};

}  // namespace scree::terrain
