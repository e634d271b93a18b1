#pragma once

#include "terrain/grid/soil_field.h"
#include "terrain/grid/tile_kernel.h"
#include "terrain/grid/tile_store.h"

#include <cstddef>
#include <span>

namespace scree::terrain {

/// Soil of one tile's patch, in the form that the kernel reads.
struct SoilPatch {
    PatchSoil soil;
    PatchPlane mobility;
    PatchPlane compaction;
    bool compacts = false;
    FloatBlock values;
    std::size_t n_values = 0;
};

/// The patch around a tile: its cells and kHalo more on every side.
CellWindow patch_window(const CellWindow& tile);

/// Parameters that are the same all over the window take one row instead of a plane.
SoilPatch make_soil_patch(const SoilField& field, const CellWindow& window, const SoundRule& rule);

/// Rows [first, end) of a patch.
struct RowRange {
    int first = 0;
    int end = kPatchHeight;
};

/// Memory for one patch at a time.
class PatchScratch {
public:
    PatchScratch();

    /// The patch around a tile, without loads.
    /// @param rows  Those that steps read; others hold anything.
    Patch prepare(const Heightfield& base, const TileStore& store, const SoilPatch& soil, int tile,
                  const RowRange& rows);
    /// Give the patch the loads; those that do not reach it cost nothing.
    void add_loads(Patch& patch, std::span<const Load> loads, const CellWindow& window,
                   const SoilPatch& soil, const SoundRule& rule, const RowRange& rows);

    static std::size_t bytes();

private:
    float* plane(int index);
    void gather_loads(std::span<const Load> loads, const CellWindow& window,
                      const CellWindow& ground, const RowRange& rows);

    FloatBlock values_;
};

}  // namespace scree::terrain
