#pragma once

#include "base/raster.h"
#include "terrain/grid/cell_window.h"
#include "terrain/material/description_map.h"

#include <memory>

namespace scree::terrain {

/// Soil parameters of every cell of a window, row by row.
struct SoilTile {
    FloatRaster tan_repose;  ///< Tangent of the angle of repose.
    FloatRaster repose;      ///< Radians.
    FloatRaster mobility;
    FloatRaster diffusion;
    FloatRaster compaction;
};

/// Soil parameters over a grid, made on demand: a grid of any size costs what its map costs.
///
/// Cells beyond the map's rim take the rim's values.
class SoilField {
public:
    /// The same soil everywhere.
    explicit SoilField(const Soil& soil);

    /// Soils of a map under a grid whose cells are `grid_cell_size` metres; every cell takes the
    /// nearest map cell's id and parameters.
    /// @throw InvalidInput  an id has no material, a plane has another size, a value is no number
    ///                      or negative; names the cell and the id.
    SoilField(DescriptionMap map, double grid_cell_size);

    /// Fill `tile` for the cells of `window`.
    void fill(const CellWindow& window, SoilTile& tile) const;

    /// The id at a grid cell; 0 for one soil everywhere.
    int id_at(int x, int y) const;

    /// The largest diffusion anywhere: what bounds the explicit step.
    double greatest_diffusion() const { return greatest_diffusion_; }
    /// The map that it was made from; empty ids for one soil everywhere.
    const DescriptionMap& map() const { return *map_; }

private:
    std::shared_ptr<const DescriptionMap> map_;  // copies of a field share it
    double map_cells_per_grid_cell_ = 1.0;
    double greatest_diffusion_ = 0.0;
};

}  // namespace scree::terrain
