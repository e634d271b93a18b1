#pragma once

#include "terrain/grid/cell_window.h"
#include "terrain/grid/sound_step.h"

#include <cstddef>
#include <cstdint>

namespace scree::terrain {

inline constexpr int kTileWidth = 128;
inline constexpr int kTileHeight = 128;
/// A patch is a tile with this much of its neighbours on every side.
inline constexpr int kHalo = 8;
inline constexpr int kPatchWidth = kTileWidth + 2 * kHalo;
inline constexpr int kPatchHeight = kTileHeight + 2 * kHalo;
/// Most iterations in one pass over memory: the outermost two rings of a halo hold no valid loads.
inline constexpr int kMostBlocked = kHalo - 2;

/// Values of a patch, row by row; a stride of 0 repeats one row. Loops read one cell before a row
/// and a few after it: there is memory, what it holds does not matter.
struct PatchPlane {
    const float* values = nullptr;
    std::ptrdiff_t stride = 0;

    const float* row(int y) const { return values + y * stride; }
};

/// Soil of a patch as the arithmetic takes it.
struct PatchSoil {
    bool uniform = true;
    float threshold = 0.0F;      ///< As threshold_plane, where the soil is uniform.
    float diffusion = 0.0F;      ///< As diffusion_x, where the soil is uniform.
    PatchPlane threshold_plane;  ///< tan(repose) * cell size; radians of repose if weighted.
    PatchPlane diffusion_x;      ///< Of the face to the left of a cell, times the time step.
    PatchPlane diffusion_z;      ///< Of the face above a cell, times the time step.
};

/// Loads on a patch; `underside.values` is null where there is none.
struct PatchLoad {
    PatchPlane push_x;     ///< Unlimited push to the right through the face left of a cell, metres.
    PatchPlane push_z;     ///< Unlimited push down through the face above a cell, metres.
    PatchPlane outflow;    ///< Sum of the unlimited pushes out of a cell, metres.
    PatchPlane underside;  ///< Metres.
    PatchPlane compaction;  ///< Share of the penetration pressed together; null if none anywhere.
};

/// A tile and the eight around it, row by row; blocks of zeros where one does not exist.
struct TileBlocks {
    const float* tiles[3][3] = {};
};

/// A tile with its surroundings, ready for some iterations.
struct Patch {
    TileBlocks source;   ///< Displacements before the iterations.
    float* u = nullptr;  ///< Memory for them, rows of kPatchWidth; filled and stepped in place.
    PatchPlane base;
    PatchSoil soil;
    PatchLoad load;
    int first_row = 0;  ///< Patch row of the ground's first row, or less than 0.
    int rows_end = 0;   ///< Patch row after the ground's last row, or more than kPatchHeight.
    int first_column = 0;
    int columns_end = 0;
};

/// What the iterations of a pass did to the tile inside of a patch.
struct PatchChange {
    int first_row = kTileHeight;             ///< Rows of the tile with changed cells: of the last
    int last_row = -1;                       ///< iteration alone.
    std::uint32_t columns[kTileWidth] = {};  ///< Not 0 where a column of the tile changed.
    double compacted = 0.0;                  ///< Sum of the heights pressed together, metres.
};

/// A tile away from loads, for one iteration where it lies.
struct DirectTile {
    const float* here = nullptr;   ///< Rows of kTileWidth, of zeros where a tile does not exist.
    const float* above = nullptr;  ///< The tiles around it; null where the ground ends, without
    const float* below = nullptr;  ///< flux through the rim.
    const float* left = nullptr;
    const float* right = nullptr;
    PatchPlane base;  ///< Row 0 begins with the tile's first cell, and has a float before it.
    PatchSoil soil;   ///< Of the tile's patch.
};

/// One iteration over tile rows [begin, end), which `out` takes.
void step_tile(const DirectTile& tile, const SoundRule& rule, int begin, int end, float* out,
               PatchChange& change);

/// Tile rows to compute in the last iteration, as rows of the patch, and how many iterations.
struct PatchSteps {
    int first = 0;
    int end = 0;
    int iterations = 1;
    int least_row = 0;  ///< Rows outside of these stay as they are.
    int rows_bound = 0;
};

/// Iterations on a patch, each of which computes one row less at either end than the one before.
///
/// @param out  The tile's rows of kTileWidth; of these, the rows [first, end) that lie within
///             least_row and rows_bound take the new values.
void step_patch(const Patch& patch, const SoundRule& rule, const PatchSteps& steps, float* out,
                PatchChange& change);

}  // namespace scree::terrain
