#include "terrain/grid/tile_store.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

namespace scree::terrain {
namespace {

constexpr std::size_t kPad = 16;  // floats
constexpr std::size_t kTileCells = std::size_t{kTileWidth} * kTileHeight;

int parts(int size, int part) {
    return (size + part - 1) / part;
}

}  // namespace

void AlignedFree::operator()(float* values) const {
    ::operator delete[](values - kPad, std::align_val_t{64});
}

FloatBlock make_block(std::size_t n) {
    const std::size_t n_bytes = (n + 2 * kPad) * sizeof(float);
    auto* values = static_cast<float*>(::operator new[](n_bytes, std::align_val_t{64}));
    std::memset(values, 0, n_bytes);
    return FloatBlock(values + kPad);
}

TileStore::TileStore(int width, int height)
    : width_(width),
      height_(height),
      columns_(parts(width, kTileWidth)),
      rows_(parts(height, kTileHeight)),
      blocks_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
      zeros_(make_block(kTileCells)) {}

CellWindow TileStore::cells(int tile) const {
    return {tile % columns_ * kTileWidth, tile / columns_ * kTileHeight, kTileWidth, kTileHeight};
}

TileBlocks TileStore::around(int tile) const {
    const int column = tile % columns_;
    const int row = tile / columns_;
    TileBlocks blocks;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const bool inside =
                column + x >= 0 && column + x < columns_ && row + y >= 0 && row + y < rows_;
            blocks.tiles[y + 1][x + 1] =
                inside ? values_or_zeros(tile + y * columns_ + x) : zeros_.get();
        }
    return blocks;
}

FloatBlock TileStore::take() {
    {
        const std::lock_guard lock(guard_);
        if (!spare_.empty()) {
            FloatBlock block = std::move(spare_.back());
            spare_.pop_back();
            return block;
        }
        ++n_blocks_;
    }
    return make_block(kTileCells);
}

void TileStore::give(FloatBlock block) {
    if (!block)
        return;
    const std::lock_guard lock(guard_);
    spare_.push_back(std::move(block));
}

void TileStore::put(int tile, FloatBlock block) {
    std::swap(blocks_[static_cast<std::size_t>(tile)], block);
    give(std::move(block));
}

void TileStore::read(const CellWindow& window, float* out, std::ptrdiff_t stride) const {
    const CellWindow inside =
        intersection(window, {0, 0, columns_ * kTileWidth, rows_ * kTileHeight});
    if (inside != window)
        for (int y = 0; y < window.height; ++y)
            std::fill_n(out + y * stride, window.width, 0.0F);
    if (inside.empty())
        return;
    const int last_column = (inside.x + inside.width - 1) / kTileWidth;
    const int last_row = (inside.y + inside.height - 1) / kTileHeight;
    for (int row = inside.y / kTileHeight; row <= last_row; ++row)
        for (int column = inside.x / kTileWidth; column <= last_column; ++column) {
            const int tile = row * columns_ + column;
            const CellWindow tile_cells = cells(tile);
            const CellWindow part = intersection(inside, tile_cells);
            const auto n = static_cast<std::size_t>(part.width);
            float* to = out + (part.y - window.y) * stride + (part.x - window.x);
            const float* from = values(tile);
            if (from)
                from += (part.y - tile_cells.y) * kTileWidth + (part.x - tile_cells.x);
            for (int y = 0; y < part.height; ++y) {
                if (from)
                    std::memcpy(to + y * stride, from + y * kTileWidth, n * sizeof(float));
                else
                    std::memset(to + y * stride, 0, n * sizeof(float));
            }
        }
}

double TileStore::sum() const {
    double sum = 0.0;
    for (const FloatBlock& block : blocks_)
        if (block)
            for (std::size_t i = 0; i < kTileCells; ++i)
                sum += double{block[i]};
    return sum;
}

std::size_t TileStore::bytes() const {
    const std::lock_guard lock(guard_);
    return (n_blocks_ + 1) * (kTileCells + 2 * kPad) * sizeof(float) +
           (blocks_.capacity() + spare_.capacity()) * sizeof(FloatBlock);
}

}  // namespace scree::terrain
