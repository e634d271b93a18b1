#include "terrain/material/map_rules.h"

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/material/map_check.h"
#include "terrain/material/soil_mix.h"
#include "terrain/material/water_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::terrain {
namespace {

using Place = std::array<double, kRuleQuantities>;

constexpr auto kWater = static_cast<std::size_t>(RuleQuantity::WaterDistance);

bool is_bounded(const RuleRange& range) {
    return range.low > -std::numeric_limits<double>::infinity() ||
           range.high < std::numeric_limits<double>::infinity();
}

const Material& material_of(const std::vector<Material>& materials, int id) {
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [id](const Material& m) { return m.id == id; });
    if (found == materials.end())
        fail<InvalidInput>("the rules ask for id ", id, ", which has no material");
    return *found;
}

void check_rules(const RuleSet& set, const std::vector<Material>& materials) {
    material_of(materials, set.otherwise);
    for (std::size_t i = 0; i < set.rules.size(); ++i) {
        material_of(materials, set.rules[i].id);
        for (std::size_t q = 0; q < kRuleQuantities; ++q) {
            const RuleRange& range = set.rules[i].ranges[q];
            if (!(range.low <= range.high) || !(range.soft >= 0.0 && range.soft < 1e9))
                fail<InvalidInput>("rule ", i, " has the range [", range.low, ", ", range.high,
                                   "] of ", kRuleQuantityNames[q], ", softened over ", range.soft,
                                   "; low must not be above high, nor soft below 0");
            if (q == kWater && is_bounded(range) && !set.water_level)
                fail<InvalidInput>("rule ", i, " asks for water_distance, but there is no ",
                                   "water_level");
        }
    }
    if (set.water_level && !std::isfinite(*set.water_level))
        fail<InvalidInput>("the rules' water level is no number");
}

// Differences over two cells, over one at the rim.
double slope_deg(const Heightfield& ground, int x, int y) {
    const FloatRaster& h = ground.heights;
    const int x0 = std::max(0, x - 1), x1 = std::min(h.width() - 1, x + 1);
    const int y0 = std::max(0, y - 1), y1 = std::min(h.height() - 1, y + 1);
    const double dx = (double{h(x1, y)} - h(x0, y)) / ((x1 - x0) * ground.cell_size);
    const double dz = (double{h(x, y1)} - h(x, y0)) / ((y1 - y0) * ground.cell_size);
    return std::atan(std::hypot(dx, dz)) * 180.0 / std::numbers::pi;
}

// The rim takes the second difference of the cells beside it.
double curvature(const Heightfield& ground, int x, int y) {
    const FloatRaster& h = ground.heights;
    const auto second = [](double a, double b, double c) { return a - 2.0 * b + c; };
    const int cx = std::clamp(x, 1, std::max(1, h.width() - 2));
    const int cy = std::clamp(y, 1, std::max(1, h.height() - 2));
    const double across = h.width() < 3 ? 0.0 : second(h(cx - 1, y), h(cx, y), h(cx + 1, y));
    const double along = h.height() < 3 ? 0.0 : second(h(x, cy - 1), h(x, cy), h(x, cy + 1));
    return 0.5 * (across + along) / (ground.cell_size * ground.cell_size);
}

Place place_at(const Heightfield& ground, const FloatRaster& water, int x, int y) {
    return {ground.heights(x, y), slope_deg(ground, x, y), curvature(ground, x, y),
            water.empty() ? 0.0 : double{water(x, y)}};
}

bool fits(const MapRule& rule, const Place& place) {
    for (std::size_t q = 0; q < kRuleQuantities; ++q)
        if (!(place[q] >= rule.ranges[q].low && place[q] <= rule.ranges[q].high))
            return false;
    return true;
}

// One inside, a half at the end, zero half the soft width beyond it.
double side(double inside, double soft) {
    if (soft <= 0.0 || std::isinf(inside))
        return inside >= 0.0 ? 1.0 : 0.0;
    const double s = std::clamp(0.5 + inside / soft, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
}

double membership(const MapRule& rule, const Place& place) {
    double share = 1.0;
    for (std::size_t q = 0; q < kRuleQuantities; ++q) {
        const RuleRange& range = rule.ranges[q];
        if (is_bounded(range))
            share *=
                side(place[q] - range.low, range.soft) * side(range.high - place[q], range.soft);
    }
    return share;
}

int id_at(const RuleSet& set, const Place& place) {
    for (const MapRule& rule : set.rules)
        if (fits(rule, place))
            return rule.id;
    return set.otherwise;
}

SoilMix mix_at(const RuleSet& set, const Place& place, const std::array<Soil, 256>& soils) {
    SoilMix mix;
    double left = 1.0;
    for (const MapRule& rule : set.rules) {
        const double share = membership(rule, place);
        if (share > 0.0)
            mix.add(soils[static_cast<std::size_t>(rule.id)], left * share);
        left *= 1.0 - share;
        if (left <= 0.0)
            break;
    }
    mix.add(soils[static_cast<std::size_t>(set.otherwise)], left);
    return mix;
}

bool is_soft(const RuleSet& set) {
    for (const MapRule& rule : set.rules)
        for (const RuleRange& range : rule.ranges)
            if (range.soft > 0.0)
                return true;
    return false;
}

}  // namespace

DescriptionMap map_from_rules(const Heightfield& ground, const RuleSet& rules,
                              const std::vector<Material>& materials) {
    check_heightfield(ground);
    check_materials(materials, "the table of materials");
    check_rules(rules, materials);
    const int width = ground.heights.width();
    const int height = ground.heights.height();
    check_map_size(width, height, "the height map");
    std::array<Soil, 256> soils;
    for (const Material& material : materials)
        soils[static_cast<std::size_t>(material.id)] = material.soil;
    DescriptionMap map;
    map.cell_size = ground.cell_size;
    map.materials = materials;
    map.ids = Raster<std::uint8_t>(width, height);
    const bool soft = is_soft(rules);
    if (soft)
        map.repose = map.mobility = map.diffusion = FloatRaster(width, height);
    const FloatRaster water =
        rules.water_level ? water_distance(ground, *rules.water_level) : FloatRaster();
    parallel_for_each_index(0, static_cast<std::size_t>(height), 16, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            const Place place = place_at(ground, water, x, y);
            map.ids(x, y) = static_cast<std::uint8_t>(id_at(rules, place));
            if (!soft)
                continue;
            const SoilMix mix = mix_at(rules, place, soils);
            map.repose(x, y) = static_cast<float>(mix.repose());
            map.mobility(x, y) = static_cast<float>(mix.mobility());
            map.diffusion(x, y) = static_cast<float>(mix.diffusion());
        }
    });
    check_map(map, "the map made by rules");
    return map;
}

}  // namespace scree::terrain
