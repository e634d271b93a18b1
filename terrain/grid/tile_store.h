#pragma once

#include "terrain/grid/cell_window.h"
#include "terrain/grid/tile_kernel.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace scree::terrain {

struct AlignedFree {
    void operator()(float* values) const;
};
/// Floats on the boundary of a cache line, with readable memory before and after them.
using FloatBlock = std::unique_ptr<float[], AlignedFree>;

/// @return `n` floats, all zero.
FloatBlock make_block(std::size_t n);

/// The displacements of a grid in tiles of kTileWidth x kTileHeight cells; tiles without any do not
/// exist. Blocks that are given back are used again.
class TileStore {
public:
    TileStore(int width, int height);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    int n_tiles() const { return columns_ * rows_; }
    CellWindow extent() const { return {0, 0, width_, height_}; }
    /// The cells of a tile, those outside the grid included.
    CellWindow cells(int tile) const;

    /// The tile's values, rows of kTileWidth; null where nothing was displaced.
    const float* values(int tile) const { return blocks_[static_cast<std::size_t>(tile)].get(); }

    /// The same, but zeros where nothing was displaced.
    const float* values_or_zeros(int tile) const {
        const float* own = values(tile);
        return own ? own : zeros_.get();
    }

    /// A tile and those around it.
    TileBlocks around(int tile) const;

    /// A block for one tile, its contents anything. Any thread may call these two.
    FloatBlock take();
    void give(FloatBlock block);
    /// Put `block` in the place of the tile's own, which is given back.
    void put(int tile, FloatBlock block);

    /// Copy a window, which may reach over the rim of the grid, to rows of `stride` floats; zero
    /// where there is nothing.
    void read(const CellWindow& window, float* out, std::ptrdiff_t stride) const;

    /// Sum of all values, in double.
    double sum() const;

    std::size_t bytes() const;

private:
    int width_, height_, columns_, rows_;
    std::vector<FloatBlock> blocks_;
    std::vector<FloatBlock> spare_;
    FloatBlock zeros_;
    std::size_t n_blocks_ = 0;
    mutable std::mutex guard_;
};

}  // namespace scree::terrain
