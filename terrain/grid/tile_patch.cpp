#include "terrain/grid/tile_patch.h"

#include "base/simd.h"
#include "terrain/grid/face_flux.h"

#include <algorithm>
#include <limits>

namespace scree::terrain {
namespace {

constexpr std::ptrdiff_t kPad = 32;  // loops read a little before and after a plane
constexpr std::size_t kPlaneFloats = std::size_t{kPatchWidth} * kPatchHeight + 2 * kPad;
constexpr std::size_t kRowFloats = kPatchWidth + 2 * kPad;

enum Plane { kU, kBase, kForceX, kForceZ, kPushX, kPushZ, kOutflow, kUnderside, kCompaction };
constexpr int kPlanes = kCompaction + 1;

bool same_everywhere(const FloatRaster& raster) {
    const float first = *raster.begin();
    return std::all_of(raster.begin(), raster.end(), [first](float v) { return v == first; });
}

/// Hands out planes of a patch's soil; the first pass over them only counts.
class PlaneMaker {
public:
    explicit PlaneMaker(float* values) : next_(values) {}

    /// Plane whose cell (x, y) is `value(x, y)`; a row if it is the same everywhere.
    template <class Value>
    PatchPlane make(bool same, Value&& value) {
        const std::size_t n = same ? kRowFloats : kPlaneFloats;
        used_ += n;
        if (!next_)
            return {};
        float* first = next_ + kPad;
        next_ += n;
        for (int y = 0; y < (same ? 1 : kPatchHeight); ++y)
            for (int x = 0; x < kPatchWidth; ++x)
                first[y * kPatchWidth + x] = value(x, y);
        if (same)  // the loops' reads before the row are of real cells here
            std::fill_n(first - kPad, kRowFloats, first[0]);
        return {first, same ? 0 : kPatchWidth};
    }
    std::size_t used() const { return used_; }

private:
    float* next_;
    std::size_t used_ = 0;
};

/// @param tile  Soil of the patch's window and one cell more to the left and above.
void make_planes(const SoilTile& tile, const SoundRule& rule, PlaneMaker& maker, SoilPatch& patch) {
    const bool weighted = rule.slide != Slide::Excess;
    const FloatRaster& repose = weighted ? tile.repose : tile.tan_repose;
    const bool same_repose = same_everywhere(repose);
    const bool same_diffusion = same_everywhere(tile.diffusion);
    const FloatRaster& d = tile.diffusion;
    PatchSoil& soil = patch.soil;
    soil.uniform = same_repose && same_diffusion;
    soil.threshold_plane = maker.make(same_repose, [&](int x, int y) {
        return weighted ? repose(x + 1, y + 1) : repose(x + 1, y + 1) * rule.cell_size;
    });
    soil.diffusion_x = maker.make(same_diffusion, [&](int x, int y) {
        return face_diffusion(d(x, y + 1), d(x + 1, y + 1)) * rule.time_step;
    });
    soil.diffusion_z = maker.make(same_diffusion, [&](int x, int y) {
        return face_diffusion(d(x + 1, y), d(x + 1, y + 1)) * rule.time_step;
    });
    patch.mobility = maker.make(same_everywhere(tile.mobility),
                                [&](int x, int y) { return tile.mobility(x + 1, y + 1); });
    patch.compaction = maker.make(same_everywhere(tile.compaction),
                                  [&](int x, int y) { return tile.compaction(x + 1, y + 1); });
}

/// Pushes through the faces between two rows of cells, without the limiter (C.9).
SCREE_MULTIVERSION void push_between(const float* force0, const float* force1,
                                     const float* mobility0, const float* mobility1, float scale,
                                     float* __restrict push) {
    for (int x = 0; x < kPatchWidth; ++x) {
        const float mobility = (mobility0[x] + mobility1[x]) * 0.5F;
        const float force = (force0[x] + force1[x]) * 0.5F;
        push[x] = (mobility * force) * scale;
    }
}

SCREE_MULTIVERSION void outflow_of(const float* push_x, const float* push_z,
                                   const float* push_z_below, float* __restrict outflow) {
    for (int x = 0; x < kPatchWidth; ++x)
        outflow[x] = (std::max(push_x[x + 1], 0.0F) + std::max(-push_x[x], 0.0F)) +
                     (std::max(push_z_below[x], 0.0F) + std::max(-push_z[x], 0.0F));
}

SCREE_MULTIVERSION void compaction_share(const float* compaction, const float* mobility,
                                         float time_step, float* __restrict share) {
    for (int x = 0; x < kPatchWidth; ++x)
        share[x] = std::min(compaction[x] * mobility[x] * time_step, 1.0F);
}

/// Rim cells whose displacement stays zero lose nothing to compaction either.
void clear_rim(const Patch& patch, float* share) {
    for (int y = 0; y < kPatchHeight; ++y) {
        float* row = share + y * kPatchWidth;
        if (y == patch.first_row || y == patch.rows_end - 1)
            std::fill_n(row, kPatchWidth, 0.0F);
        if (patch.first_column >= 0)
            row[patch.first_column] = 0.0F;
        if (patch.columns_end <= kPatchWidth)
            row[patch.columns_end - 1] = 0.0F;
    }
}

}  // namespace

CellWindow patch_window(const CellWindow& tile) {
    return {tile.x - kHalo, tile.y - kHalo, kPatchWidth, kPatchHeight};
}

SoilPatch make_soil_patch(const SoilField& field, const CellWindow& window, const SoundRule& rule) {
    SoilTile tile;
    field.fill({window.x - 1, window.y - 1, window.width + 1, window.height + 1}, tile);
    SoilPatch patch;
    PlaneMaker counter(nullptr);
    make_planes(tile, rule, counter, patch);
    patch.n_values = counter.used();
    patch.values = make_block(patch.n_values);
    PlaneMaker maker(patch.values.get());
    make_planes(tile, rule, maker, patch);
    patch.soil.threshold = *patch.soil.threshold_plane.values;
    patch.soil.diffusion = *patch.soil.diffusion_x.values;
    patch.compacts =
        std::any_of(tile.compaction.begin(), tile.compaction.end(), [](float c) { return c > 0; });
    return patch;
}

PatchScratch::PatchScratch() : values_(make_block(kPlanes * kPlaneFloats)) {}

std::size_t PatchScratch::bytes() {
    return kPlanes * kPlaneFloats * sizeof(float);
}

float* PatchScratch::plane(int index) {
    return values_.get() + static_cast<std::size_t>(index) * kPlaneFloats + kPad;
}

Patch PatchScratch::prepare(const Heightfield& base, const TileStore& store, const SoilPatch& soil,
                            int tile, const RowRange& rows) {
    const CellWindow window = patch_window(store.cells(tile));
    const FloatRaster& heights = base.heights;
    Patch patch;
    patch.u = plane(kU);
    patch.soil = soil.soil;
    patch.first_row = -window.y;
    patch.rows_end = heights.height() - window.y;
    patch.first_column = -window.x;
    patch.columns_end = heights.width() - window.x;
    const CellWindow read{window.x, window.y + rows.first, window.width, rows.end - rows.first};
    const std::ptrdiff_t start = rows.first * kPatchWidth;
    patch.source = store.around(tile);
    if (window.x > 0 && read.y >= 0 && window.x + window.width <= heights.width() &&
        read.y + read.height <= heights.height()) {
        patch.base = {heights.row(read.y) + window.x - std::ptrdiff_t{rows.first} * heights.width(),
                      heights.width()};
        return patch;
    }
    float* copy = plane(kBase);
    const CellWindow part = intersection(read, {0, 0, heights.width(), heights.height()});
    if (part != read)
        std::fill_n(copy + start, kPatchWidth * read.height, 0.0F);
    for (int y = part.y; y < part.y + part.height; ++y)
        std::copy_n(heights.row(y) + part.x, part.width,
                    copy + (y - window.y) * kPatchWidth + (part.x - window.x));
    patch.base = {copy, kPatchWidth};
    return patch;
}

void PatchScratch::gather_loads(std::span<const Load> loads, const CellWindow& window,
                                const CellWindow& ground, const RowRange& rows) {
    const std::ptrdiff_t start = rows.first * kPatchWidth;
    const int cells = (rows.end - rows.first) * kPatchWidth;
    std::fill_n(plane(kForceX) + start, cells, 0.0F);
    std::fill_n(plane(kForceZ) + start, cells, 0.0F);
    std::fill_n(plane(kUnderside) + start, cells, std::numeric_limits<float>::infinity());
    for (const Load& load : loads) {
        const CellWindow part = intersection(ground, load.window);
        for (int y = part.y; y < part.y + part.height; ++y) {
            const int at = (y - window.y) * kPatchWidth + (part.x - window.x);
            float* x_force = plane(kForceX) + at;
            float* z_force = plane(kForceZ) + at;
            float* underside = plane(kUnderside) + at;
            for (int x = 0; x < part.width; ++x) {
                const int lx = part.x - load.window.x + x;
                const int ly = y - load.window.y;
                x_force[x] += load.force_x(lx, ly);
                z_force[x] += load.force_z(lx, ly);
                underside[x] = std::min(underside[x], load.underside(lx, ly));
            }
        }
    }
}

void PatchScratch::add_loads(Patch& patch, std::span<const Load> loads, const CellWindow& window,
                             const SoilPatch& soil, const SoundRule& rule, const RowRange& rows) {
    const int left = std::max(0, patch.first_column);
    const int top = std::max(rows.first, patch.first_row);
    const CellWindow ground = {window.x + left, window.y + top,
                               std::min(kPatchWidth, patch.columns_end) - left,
                               std::min(rows.end, patch.rows_end) - top};
    const bool reached = std::any_of(loads.begin(), loads.end(), [&](const Load& load) {
        return !intersection(ground, load.window).empty();
    });
    if (!reached)
        return;
    gather_loads(loads, window, ground, rows);
    const float scale = rule.time_step * rule.cell_size;
    for (int y = rows.first + 1; y < rows.end; ++y) {
        const std::ptrdiff_t at = y * kPatchWidth;
        const float* mobility = soil.mobility.row(y);
        float* push_x = plane(kPushX) + at;
        float* push_z = plane(kPushZ) + at;
        push_between(plane(kForceX) + at - 1, plane(kForceX) + at, mobility - 1, mobility, scale,
                     push_x);
        push_between(plane(kForceZ) + at - kPatchWidth, plane(kForceZ) + at,
                     soil.mobility.row(y - 1), mobility, scale, push_z);
        if (y == patch.first_row || y == patch.rows_end)
            std::fill_n(push_z, kPatchWidth, 0.0F);
        if (patch.first_column >= 0)
            push_x[patch.first_column] = 0.0F;
        if (patch.columns_end <= kPatchWidth)
            push_x[patch.columns_end] = 0.0F;
    }
    for (int y = rows.first + 1; y + 1 < rows.end; ++y) {
        const std::ptrdiff_t at = y * kPatchWidth;
        outflow_of(plane(kPushX) + at, plane(kPushZ) + at, plane(kPushZ) + at + kPatchWidth,
                   plane(kOutflow) + at);
    }
    patch.load = {{plane(kPushX), kPatchWidth},
                  {plane(kPushZ), kPatchWidth},
                  {plane(kOutflow), kPatchWidth},
                  {plane(kUnderside), kPatchWidth},
                  {}};
    if (!soil.compacts)
        return;
    for (int y = rows.first; y < rows.end; ++y)
        compaction_share(soil.compaction.row(y), soil.mobility.row(y), rule.time_step,
                         plane(kCompaction) + y * kPatchWidth);
    if (rule.border == Border::Zero)
        clear_rim(patch, plane(kCompaction));
    patch.load.compaction = {plane(kCompaction), kPatchWidth};
}

}  // namespace scree::terrain
