#include "terrain/material/material_layers.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/material/map_check.h"
#include "terrain/material/soil_mix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree::terrain {
namespace {

constexpr double kMaxAmounts = 2e9;
constexpr std::size_t kRows = 8;  // of a piece of parallel work

using Layer = std::vector<Raster<double>>;

void check_layers(const MaterialLayers& layers) {
    check_materials(layers.materials, "the layers");
    if (layers.amounts.empty())
        fail<InvalidInput>("the layers are none, at least one is needed");
    for (const Layer& layer : layers.amounts) {
        if (layer.size() != layers.materials.size())
            fail<InvalidInput>("a layer holds ", layer.size(), " materials of ",
                               layers.materials.size());
        for (const Raster<double>& amounts : layer)
            if (amounts.width() != layers.width() || amounts.height() != layers.height())
                fail<InvalidInput>("the rasters of the layers differ in size");
    }
}

double thickness_at(const Layer& layer, std::size_t cell) {
    double sum = 0.0;
    for (const Raster<double>& amounts : layer)
        sum += amounts.data()[cell];
    return sum;
}

Raster<double> thickness_of(const Layer& layer) {
    Raster<double> sum(layer[0].width(), layer[0].height());
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum.data()[i] = thickness_at(layer, i);
    return sum;
}

template <class Body>
void for_rows(int height, Body&& body) {
    parallel_for_each_index(0, static_cast<std::size_t>(height), kRows,
                            [&](std::size_t y) { body(static_cast<int>(y)); });
}

// What the cell gains of one material from a neighbour: the neighbour computes the same number with
// the other sign, so nothing is made or lost.
struct Exchange {
    const Raster<double>& amount;
    const Raster<double>& thickness;
    double share;

    double gain(int x, int y, int u, int v) const {
        if (!amount.contains(u, v))
            return 0.0;
        const double mine = thickness(x, y);
        const double other = thickness(u, v);
        if (!(mine > 0.0 && other > 0.0))
            return 0.0;
        return share * (amount(u, v) / other - amount(x, y) / mine) * std::min(mine, other);
    }
};

void mix_sideways(Layer& layer, double share) {
    const Raster<double> thickness = thickness_of(layer);
    for (Raster<double>& amounts : layer) {
        Raster<double> next = amounts;
        const Exchange exchange{amounts, thickness, share};
        for_rows(amounts.height(), [&](int y) {
            for (int x = 0; x < amounts.width(); ++x) {
                const double gained =
                    (exchange.gain(x, y, x - 1, y) + exchange.gain(x, y, x + 1, y)) +
                    (exchange.gain(x, y, x, y - 1) + exchange.gain(x, y, x, y + 1));
                next(x, y) = std::max(0.0, amounts(x, y) + gained);
            }
        });
        amounts = std::move(next);
    }
}

void mix_downwards(Layer& upper, Layer& lower, double share) {
    const int height = upper[0].height();
    const auto width = static_cast<std::size_t>(upper[0].width());
    for_rows(height, [&](int y) {
        const std::size_t first = static_cast<std::size_t>(y) * width;
        for (std::size_t i = first; i < first + width; ++i) {
            const double above = thickness_at(upper, i);
            const double below = thickness_at(lower, i);
            if (!(above > 0.0 && below > 0.0))
                continue;
            for (std::size_t m = 0; m < upper.size(); ++m) {
                double& a = upper[m].data()[i];
                double& b = lower[m].data()[i];
                const double moved = share * (b / below - a / above) * std::min(above, below);
                a = std::max(0.0, a + moved);
                b = std::max(0.0, b - moved);
            }
        }
    });
}

std::size_t slot_below(const DescriptionMap& map, int id) {
    for (std::size_t slot = 0; slot < map.materials.size(); ++slot)
        if (map.materials[slot].id == id)
            return slot;
    fail<InvalidInput>("a layer is to be of id ", id, ", which has no material");
}

// Amount of every material in the uppermost `depth` of a cell.
void take_from_top(const MaterialLayers& layers, std::size_t cell, double depth,
                   std::array<double, kMaxMaterials>& taken) {
    taken.fill(0.0);
    for (const Layer& layer : layers.amounts) {
        const double thickness = thickness_at(layer, cell);
        if (!(thickness > 0.0))
            continue;
        const double part = std::min(1.0, depth / thickness);
        for (std::size_t m = 0; m < layer.size(); ++m)
            taken[m] += part * layer[m].data()[cell];
        depth -= thickness;
        if (!(depth > 0.0))
            return;
    }
}

}  // namespace

MaterialLayers layers_of_map(const DescriptionMap& map, std::span<const double> thickness_m,
                             std::span<const int> below) {
    check_map(map, "the map of the layers");
    if (thickness_m.empty())
        fail<InvalidInput>("the layers are none, at least one is needed");
    if (!below.empty() && below.size() + 1 != thickness_m.size())
        fail<InvalidInput>("there are ", thickness_m.size() - 1, " layers below the first and ",
                           below.size(), " materials for them");
    const double amounts = static_cast<double>(map.ids.size()) *
                           static_cast<double>(map.materials.size() * thickness_m.size());
    if (amounts > kMaxAmounts)
        fail<InvalidInput>("the layers need ", amounts, " amounts, the limit is ", kMaxAmounts,
                           "; use fewer layers, fewer materials or larger cells");
    const std::array<int, 256> slots = slots_of_ids(map.materials);
    MaterialLayers layers{map.cell_size, map.materials, {}};
    for (std::size_t n = 0; n < thickness_m.size(); ++n) {
        if (!(thickness_m[n] > 0.0 && thickness_m[n] <= 1e6))
            fail<InvalidInput>("layer ", n, " has a thickness of ", thickness_m[n],
                               " m, must be in (0, 1e6]");
        Layer layer(map.materials.size(), Raster<double>(map.ids.width(), map.ids.height()));
        const bool own = n == 0 || below.empty();
        const std::size_t given = own ? 0 : slot_below(map, below[n - 1]);
        for (std::size_t i = 0; i < map.ids.size(); ++i) {
            const std::size_t slot =
                own ? static_cast<std::size_t>(slots[map.ids.data()[i]]) : given;
            layer[slot].data()[i] = thickness_m[n];
        }
        layers.amounts.push_back(std::move(layer));
    }
    return layers;
}

MixReport mix_layers(MaterialLayers& layers, const MixOptions& options) {
    check(options);
    check_layers(layers);
    MixReport report{material_volumes(layers), {}};
    for (int step = 0; step < options.steps; ++step) {
        if (options.sideways > 0.0)
            for (Layer& layer : layers.amounts)
                mix_sideways(layer, options.sideways);
        if (options.downwards > 0.0)
            for (std::size_t n = 0; n + 1 < layers.amounts.size(); ++n)
                mix_downwards(layers.amounts[n], layers.amounts[n + 1], options.downwards);
    }
    report.after_m3 = material_volumes(layers);
    return report;
}

std::vector<double> material_volumes(const MaterialLayers& layers) {
    check_layers(layers);
    std::vector<double> volumes(layers.materials.size(), 0.0);
    for (const Layer& layer : layers.amounts)
        for (std::size_t m = 0; m < layer.size(); ++m)
            for (const double amount : layer[m])
                volumes[m] += amount;
    for (double& volume : volumes)
        volume *= layers.cell_size * layers.cell_size;
    return volumes;
}

DescriptionMap surface_map(const MaterialLayers& layers, double depth_m) {
    check_layers(layers);
    if (!(depth_m > 0.0))
        fail<InvalidInput>("the depth of the surface is ", depth_m, " m, must be above 0");
    DescriptionMap map;
    map.cell_size = layers.cell_size;
    map.materials = layers.materials;
    map.ids = Raster<std::uint8_t>(layers.width(), layers.height());
    map.repose = map.mobility = map.diffusion = FloatRaster(layers.width(), layers.height());
    const std::size_t n_materials = map.materials.size();
    const auto width = static_cast<std::size_t>(layers.width());
    for_rows(layers.height(), [&](int y) {
        std::array<double, kMaxMaterials> taken;
        for (std::size_t i = static_cast<std::size_t>(y) * width;
             i < static_cast<std::size_t>(y + 1) * width; ++i) {
            take_from_top(layers, i, depth_m, taken);
            SoilMix mix;
            for (std::size_t m = 0; m < n_materials; ++m)
                mix.add(map.materials[m].soil, taken[m]);
            const auto most = std::max_element(
                taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(n_materials));
            const auto& top = map.materials[static_cast<std::size_t>(most - taken.begin())];
            if (mix.empty())
                mix.add(top.soil, 1.0);
            map.ids.data()[i] = static_cast<std::uint8_t>(top.id);
            map.repose.data()[i] = static_cast<float>(mix.repose());
            map.mobility.data()[i] = static_cast<float>(mix.mobility());
            map.diffusion.data()[i] = static_cast<float>(mix.diffusion());
        }
    });
    return map;
}

}  // namespace scree::terrain
