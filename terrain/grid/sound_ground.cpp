#include "terrain/grid/sound_ground.h"

#include "base/parallel.h"
#include "terrain/grid/whole_quanta.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace scree::terrain {
namespace {

CellWindow grown(const CellWindow& window, int by) {
    return {window.x - by, window.y - by, window.width + 2 * by, window.height + 2 * by};
}

/// The smallest window around both.
CellWindow hull(const CellWindow& a, const CellWindow& b) {
    const int x = std::min(a.x, b.x);
    const int y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
            std::max(a.y + a.height, b.y + b.height) - y};
}

/// Where the last iteration changed a tile.
CellWindow changed_cells(const PatchChange& change, const CellWindow& tile) {
    if (change.last_row < 0)
        return {};
    int first = 0;
    while (change.columns[first] == 0)
        ++first;
    int last = kTileWidth - 1;
    while (change.columns[last] == 0)
        --last;
    return {tile.x + first, tile.y + change.first_row, last - first + 1,
            change.last_row - change.first_row + 1};
}

/// Copy the tile's rows [begin, end), zero where the tile does not exist.
void copy_rows(const float* from, int begin, int end, float* to) {
    if (begin >= end)
        return;
    const std::size_t n = static_cast<std::size_t>(end - begin) * kTileWidth;
    if (from)
        std::copy_n(from + begin * kTileWidth, n, to + begin * kTileWidth);
    else
        std::fill_n(to + begin * kTileWidth, n, 0.0F);
}

float greatest_move(const float* before, const float* after) {
    float greatest = 0.0F;
    for (int i = 0; i < kTileWidth * kTileHeight; ++i)
        greatest = std::max(greatest, std::fabs(after[i] - (before ? before[i] : 0.0F)));
    return greatest;
}

bool same_values(const float* before, const float* after) {
    constexpr std::size_t kCells = std::size_t{kTileWidth} * kTileHeight;
    if (before)
        return std::memcmp(before, after, kCells * sizeof(float)) == 0;
    return std::all_of(after, after + kCells, [](float v) { return v == 0.0F; });
}

}  // namespace

SoundGround::SoundGround(const Heightfield& base, const SoilField& soil,
                         const DeformerOptions& options)
    : base_(&base),
      soil_(soil),
      iterations_(options.iterations),
      rule_(sound_rule(base, options)),
      store_(base.heights.width(), base.heights.height()),
      work_of_tile_(static_cast<std::size_t>(store_.n_tiles())),
      stepped_in_(static_cast<std::size_t>(store_.n_tiles())) {
    if (soil_.map().ids.empty())
        soil_patches_.push_back(std::make_unique<SoilPatch>(
            make_soil_patch(soil_, patch_window(store_.cells(0)), rule_)));
    else
        soil_patches_.resize(static_cast<std::size_t>(store_.n_tiles()));
}

DeformerReport SoundGround::step(std::span<const Load> loads, float* moved) {
    ++frame_;
    DeformerReport report;
    if (moved)
        *moved = 0.0F;
    const int n_passes = (iterations_ + kMostBlocked - 1) / kMostBlocked;
    for (int i = 0; i < n_passes; ++i) {
        const Pass pass{.loads = loads,
                        .iterations = iterations_ * (i + 1) / n_passes - iterations_ * i / n_passes,
                        .measure = moved != nullptr};
        schedule(pass, i == 0);
        parallel_for(0, work_.size(), std::clamp<std::size_t>(work_.size() / 64, 1, 8),
                     [&](std::size_t first, std::size_t last) {
                         for (std::size_t k = first; k < last; ++k)
                             run(pass, work_[k]);
                     });
        commit(report, moved);
    }
    last_windows_.clear();
    for (const Load& load : loads)
        last_windows_.push_back(load.window);
    report.tiles_stepped = static_cast<int>(stepped_.size());
    drop_idle_soil();
    report.at_rest = restless_.empty();
    fresh_ = false;
    return report;
}

/// An iteration changes a cell only if the one before changed it or one of its four neighbours, or
/// if the loads on it or them have changed.
void SoundGround::schedule(const Pass& pass, bool first) {
    for (const auto& [tile, changed] : restless_)
        reach(changed, pass.iterations);
    for (const Load& load : pass.loads)
        reach(load.window, pass.iterations);
    if (first)
        for (const CellWindow& window : last_windows_)
            reach(window, pass.iterations);
    if (first && fresh_ && !rule_.keep_base)
        reach(store_.extent(), 0);
    std::sort(work_.begin(), work_.end(),
              [](const Work& a, const Work& b) { return a.tile < b.tile; });
}

/// Take up the tiles within `distance` cells of `source`.
void SoundGround::reach(const CellWindow& source, int distance) {
    if (source.empty())
        return;
    const CellWindow area = intersection(grown(source, distance), store_.extent());
    if (area.empty())
        return;
    const int last_column = (area.x + area.width - 1) / kTileWidth;
    const int last_row = (area.y + area.height - 1) / kTileHeight;
    for (int row = area.y / kTileHeight; row <= last_row; ++row)
        for (int column = area.x / kTileWidth; column <= last_column; ++column) {
            const int tile = row * store_.columns() + column;
            const CellWindow part = intersection(area, store_.cells(tile));
            int& at = work_of_tile_[static_cast<std::size_t>(tile)];
            if (at == 0) {
                work_.push_back({.tile = tile, .region = part, .block = {}, .changed = {}});
                at = static_cast<int>(work_.size());
            } else {
                CellWindow& region = work_[static_cast<std::size_t>(at - 1)].region;
                region = hull(region, part);
            }
        }
}

void SoundGround::run(const Pass& pass, Work& work) {
    PatchChange change;
    FloatBlock block = store_.take();
    if (is_direct(pass, work.tile))
        step_direct(work, block.get(), change);
    else
        step_patched(pass, work, block.get(), change);
    finish(work, change, std::move(block), pass.measure);
}

/// Whether a tile need not be gathered with its surroundings. The ground's first tile is: there is
/// no memory before its first height.
bool SoundGround::is_direct(const Pass& pass, int tile) const {
    const CellWindow cells = store_.cells(tile);
    const CellWindow patch = patch_window(cells);
    return pass.iterations == 1 && rule_.border == Border::NoFlux && tile != 0 &&
           intersection(cells, store_.extent()) == cells &&
           std::none_of(pass.loads.begin(), pass.loads.end(), [&](const Load& load) {
               return !intersection(patch, load.window).empty();
           });
}

void SoundGround::step_direct(const Work& work, float* out, PatchChange& change) {
    const CellWindow cells = store_.cells(work.tile);
    const FloatRaster& base = base_->heights;
    const int column = work.tile % store_.columns();
    const int row = work.tile / store_.columns();
    const auto beside = [&](bool inside, int tile) {
        return inside ? store_.values_or_zeros(tile) : nullptr;
    };
    const DirectTile tile{
        .here = store_.values_or_zeros(work.tile),
        .above = beside(row > 0, work.tile - store_.columns()),
        .below = beside(row + 1 < store_.rows(), work.tile + store_.columns()),
        .left = beside(column > 0, work.tile - 1),
        .right = beside(column + 1 < store_.columns(), work.tile + 1),
        .base = {base.row(cells.y) + cells.x, base.width()},
        .soil = soil_of(work.tile).soil,
    };
    const int begin = work.region.y - cells.y;
    const int end = begin + work.region.height;
    step_tile(tile, rule_, begin, end, out, change);
    copy_rows(tile.here, 0, begin, out);
    copy_rows(tile.here, end, kTileHeight, out);
}

void SoundGround::step_patched(const Pass& pass, const Work& work, float* out,
                               PatchChange& change) {
    auto scratch = take_scratch();
    const CellWindow window = patch_window(store_.cells(work.tile));
    const SoilPatch& soil = soil_of(work.tile);
    const int first = work.region.y - window.y;
    const int end = first + work.region.height;
    // A load's push depends on cells two away, and the first iteration computes the most rows.
    const int reach_rows = std::min(pass.iterations + 2, kHalo);
    const RowRange rows{first - reach_rows, end + reach_rows};
    Patch patch = scratch->prepare(*base_, store_, soil, work.tile, rows);
    scratch->add_loads(patch, pass.loads, window, soil, rule_, rows);

    const int rim = rule_.border == Border::Zero ? 1 : 0;
    const PatchSteps steps{.first = first,
                           .end = end,
                           .iterations = pass.iterations,
                           .least_row = patch.first_row + rim,
                           .rows_bound = patch.rows_end - rim};
    step_patch(patch, rule_, steps, out, change);
    const int begin_out = std::clamp(steps.least_row, steps.first, steps.end);
    const int end_out = std::clamp(steps.rows_bound, begin_out, steps.end);
    const float* before = store_.values(work.tile);
    copy_rows(before, 0, begin_out - kHalo, out);
    copy_rows(before, end_out - kHalo, kTileHeight, out);
    give_scratch(std::move(scratch));
}

void SoundGround::finish(Work& work, const PatchChange& change, FloatBlock block, bool measure) {
    const float* before = store_.values(work.tile);
    work.changed = changed_cells(change, store_.cells(work.tile));
    work.compacted = change.compacted;
    if (work.changed.empty() && same_values(before, block.get())) {
        store_.give(std::move(block));
        return;
    }
    if (measure)
        work.moved = greatest_move(before, block.get());
    work.block = std::move(block);
}

void SoundGround::commit(DeformerReport& report, float* moved) {
    restless_.clear();
    float greatest = 0.0F;
    const double cell_area = base_->cell_size * base_->cell_size;
    for (Work& work : work_) {
        const auto tile = static_cast<std::size_t>(work.tile);
        work_of_tile_[tile] = 0;
        if (stepped_in_[tile] != frame_)
            stepped_.push_back(work.tile);
        stepped_in_[tile] = frame_;
        if (work.block)
            store_.put(work.tile, std::move(work.block));
        if (!work.changed.empty())
            restless_.emplace_back(work.tile, work.changed);
        report.compacted_m3 += work.compacted * cell_area;
        greatest = std::max(greatest, work.moved);
    }
    if (moved)
        *moved += greatest;
    work_.clear();
}

void SoundGround::replace(FloatRaster displacement) {
    round_to_quanta(displacement, rule_.quantum);
    for (int tile = 0; tile < store_.n_tiles(); ++tile) {
        const CellWindow cells = store_.cells(tile);
        const CellWindow inside = intersection(cells, store_.extent());
        FloatBlock block = store_.take();
        std::fill_n(block.get(), kTileWidth * kTileHeight, 0.0F);
        for (int y = 0; y < inside.height; ++y)
            std::copy_n(displacement.row(inside.y + y) + inside.x, inside.width,
                        block.get() + y * kTileWidth);
        if (same_values(store_.values(tile), block.get())) {
            store_.give(std::move(block));
            continue;
        }
        store_.put(tile, std::move(block));
        restless_.emplace_back(tile, inside);
    }
}

/// Only one thread works on a tile, so it may fill the tile's own slot.
const SoilPatch& SoundGround::soil_of(int tile) {
    auto& patch = soil_patches_[soil_patches_.size() == 1 ? 0 : static_cast<std::size_t>(tile)];
    if (!patch)
        patch = std::make_unique<SoilPatch>(
            make_soil_patch(soil_, patch_window(store_.cells(tile)), rule_));
    return *patch;
}

/// A tile that was not stepped in this frame is likely to rest for long.
void SoundGround::drop_idle_soil() {
    if (!soil_.map().ids.empty())
        for (const int tile : stepped_before_)
            if (stepped_in_[static_cast<std::size_t>(tile)] != frame_)
                soil_patches_[static_cast<std::size_t>(tile)].reset();
    std::swap(stepped_, stepped_before_);
    stepped_.clear();
}

std::unique_ptr<PatchScratch> SoundGround::take_scratch() {
    {
        const std::lock_guard lock(guard_);
        if (!scratch_.empty()) {
            auto scratch = std::move(scratch_.back());
            scratch_.pop_back();
            return scratch;
        }
        ++n_scratch_;
    }
    return std::make_unique<PatchScratch>();
}

void SoundGround::give_scratch(std::unique_ptr<PatchScratch> scratch) {
    const std::lock_guard lock(guard_);
    scratch_.push_back(std::move(scratch));
}

std::size_t SoundGround::bytes() const {
    std::size_t sum = store_.bytes() + n_scratch_ * PatchScratch::bytes() +
                      stepped_in_.size() * (sizeof(int) + sizeof(std::uint32_t)) +
                      soil_patches_.size() * sizeof(soil_patches_.front());
    for (const auto& patch : soil_patches_)
        if (patch)
            sum += sizeof(SoilPatch) + patch->n_values * sizeof(float);
    return sum;
}

}  // namespace scree::terrain
