#include "terrain/grid/soil_field.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace scree::terrain {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kSteepest = 89.0 * kRadians;  // as Soil::repose_deg
constexpr double kGreatestMobility = 16.0;
constexpr double kGreatestDiffusion = 4.0;

/// The material of every id; null where there is none.
using MaterialTable = std::array<const Material*, 256>;

MaterialTable table_of(const std::vector<Material>& materials) {
    MaterialTable table{};
    for (const Material& material : materials) {
        if (material.id < 0 || material.id > 255)
            fail<InvalidInput>("material '", material.name, "' has id ", material.id,
                               ", must be in [0, 255]");
        auto& entry = table[static_cast<std::size_t>(material.id)];
        if (entry)
            fail<InvalidInput>("materials '", entry->name, "' and '", material.name,
                               "' have the same id ", material.id);
        check(material.soil);
        entry = &material;
    }
    return table;
}

void check_plane(const FloatRaster& plane, std::string_view name, double greatest,
                 const DescriptionMap& map) {
    if (plane.empty())
        return;
    if (plane.width() != map.ids.width() || plane.height() != map.ids.height())
        fail<InvalidInput>("the map's ", name, " has ", plane.width(), " x ", plane.height(),
                           " cells, its ids have ", map.ids.width(), " x ", map.ids.height());
    for (int y = 0; y < plane.height(); ++y)
        for (int x = 0; x < plane.width(); ++x) {
            const double value = plane(x, y);
            const bool in_range = value >= 0.0 && value <= greatest;  // false for NaN
            if (!in_range)
                fail<InvalidInput>("the map's ", name, " in cell (", x, ", ", y, ") of id ",
                                   int{map.ids(x, y)}, " is ", value, ", must be in [0, ", greatest,
                                   "]");
        }
}

void check_map(const DescriptionMap& map, const MaterialTable& table) {
    if (map.ids.empty())
        fail<InvalidInput>("the description map has no cells");
    if (!(map.cell_size > 0.0) || !std::isfinite(map.cell_size))
        fail<InvalidInput>("the description map's cell size is ", map.cell_size,
                           " m, it must be positive");
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x)
            if (!table[map.ids(x, y)])
                fail<InvalidInput>("the map's cell (", x, ", ", y, ") has id ", int{map.ids(x, y)},
                                   ", which no material has");
    check_plane(map.repose, "repose", kSteepest + 1e-6, map);
    check_plane(map.mobility, "mobility", kGreatestMobility, map);
    check_plane(map.diffusion, "diffusion", kGreatestDiffusion, map);
}

double greatest_diffusion_of(const DescriptionMap& map, const MaterialTable& table) {
    if (!map.diffusion.empty())
        return *std::max_element(map.diffusion.begin(), map.diffusion.end());
    std::array<bool, 256> occurs{};
    for (const std::uint8_t id : map.ids)
        occurs[id] = true;
    double greatest = 0.0;
    for (std::size_t id = 0; id < occurs.size(); ++id)
        if (occurs[id])
            greatest = std::max(greatest, table[id]->soil.diffusion);
    return greatest;
}

/// Nearest map cell of every grid cell in [first, first + n), the rim carried outwards.
std::vector<int> nearest_cells(int first, int n, double map_per_grid, int map_size) {
    std::vector<int> cells(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        const double place = std::floor((first + i + 0.5) * map_per_grid);
        cells[static_cast<std::size_t>(i)] =
            static_cast<int>(std::clamp(place, 0.0, map_size - 1.0));
    }
    return cells;
}

/// Parameters of a soil as the tiles hold them.
struct SoilValues {
    explicit SoilValues(const Soil& soil)
        : repose(static_cast<float>(soil.repose_deg * kRadians)),
          mobility(static_cast<float>(soil.mobility)),
          diffusion(static_cast<float>(soil.diffusion)),
          compaction(static_cast<float>(soil.compaction)) {
        tan_repose = std::tan(repose);
    }
    float repose, tan_repose = 0.0F, mobility, diffusion, compaction;
};

void resize(FloatRaster& raster, const CellWindow& window) {
    if (raster.width() != window.width || raster.height() != window.height)
        raster = FloatRaster(window.width, window.height);
}

}  // namespace

SoilField::SoilField(const Soil& soil) {
    check(soil);
    auto map = std::make_shared<DescriptionMap>();
    Material material;
    material.name = "soil";
    material.soil = soil;
    map->materials.push_back(std::move(material));
    map_ = std::move(map);
    greatest_diffusion_ = soil.diffusion;
}

SoilField::SoilField(DescriptionMap map, double grid_cell_size) {
    if (!(grid_cell_size > 0.0) || !std::isfinite(grid_cell_size))
        fail<InvalidInput>("the grid's cell size is ", grid_cell_size, " m, it must be positive");
    const MaterialTable table = table_of(map.materials);
    check_map(map, table);
    greatest_diffusion_ = greatest_diffusion_of(map, table);
    map_cells_per_grid_cell_ = grid_cell_size / map.cell_size;
    map_ = std::make_shared<const DescriptionMap>(std::move(map));
}

void SoilField::fill(const CellWindow& window, SoilTile& tile) const {
    for (FloatRaster* plane :
         {&tile.tan_repose, &tile.repose, &tile.mobility, &tile.diffusion, &tile.compaction})
        resize(*plane, window);
    if (map_->ids.empty()) {
        const SoilValues soil(map_->materials.front().soil);
        std::fill(tile.tan_repose.begin(), tile.tan_repose.end(), soil.tan_repose);
        std::fill(tile.repose.begin(), tile.repose.end(), soil.repose);
        std::fill(tile.mobility.begin(), tile.mobility.end(), soil.mobility);
        std::fill(tile.diffusion.begin(), tile.diffusion.end(), soil.diffusion);
        std::fill(tile.compaction.begin(), tile.compaction.end(), soil.compaction);
        return;
    }
    std::vector<SoilValues> values(256, SoilValues(Soil{}));
    for (const Material& material : map_->materials)
        values[static_cast<std::size_t>(material.id)] = SoilValues(material.soil);
    const DescriptionMap& map = *map_;
    const std::vector<int> columns =
        nearest_cells(window.x, window.width, map_cells_per_grid_cell_, map.ids.width());
    const std::vector<int> rows =
        nearest_cells(window.y, window.height, map_cells_per_grid_cell_, map.ids.height());
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x) {
            const int mx = columns[static_cast<std::size_t>(x)];
            const int my = rows[static_cast<std::size_t>(y)];
            const SoilValues& soil = values[map.ids(mx, my)];
            const bool own_repose = !map.repose.empty();
            tile.repose(x, y) = own_repose ? map.repose(mx, my) : soil.repose;
            tile.tan_repose(x, y) = own_repose ? std::tan(map.repose(mx, my)) : soil.tan_repose;
            tile.mobility(x, y) = map.mobility.empty() ? soil.mobility : map.mobility(mx, my);
            tile.diffusion(x, y) = map.diffusion.empty() ? soil.diffusion : map.diffusion(mx, my);
            tile.compaction(x, y) = soil.compaction;
        }
}

int SoilField::id_at(int x, int y) const {
    if (map_->ids.empty())
        return 0;
    return map_->ids(nearest_cells(x, 1, map_cells_per_grid_cell_, map_->ids.width()).front(),
                     nearest_cells(y, 1, map_cells_per_grid_cell_, map_->ids.height()).front());
}

}  // namespace scree::terrain
