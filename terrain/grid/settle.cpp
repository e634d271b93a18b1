#include "terrain/grid/settle.h"

#include "terrain/grid/slope_envelopes.h"
#include "terrain/grid/slope_levels.h"
#include "terrain/grid/slope_limits.h"

#include <cmath>

namespace scree::terrain {

namespace {

double moved_volume(const DoubleRaster& before, const DoubleRaster& after, double cell_size) {
    double sum = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i)
        sum += std::abs(after.data()[i] - before.data()[i]);
    return 0.5 * sum * cell_size * cell_size;  // what leaves one place arrives at another
}

}  // namespace

SettleReport settle_to_rest(FloatRaster& displacement, const Heightfield& base,
                            const SoilTile& soil, const SettleOptions& options) {
    check(options);
    check_ground(base, displacement);
    check_soil_tile(base, soil);

    const DoubleRaster before = total_heights(base, displacement);
    const double cell_size = base.cell_size;
    SlopeLimits limits = slope_limits(base, soil, options.keep_base);
    SettleReport report;
    report.excess_before = report.excess = greatest_excess(before, limits, cell_size);
    report.sweeps = 1.0;
    if (report.excess <= options.tolerance)
        return report;

    SlopeLevels levels(before, std::move(limits));
    while (report.cycles < options.cycles && report.excess > options.tolerance) {
        levels.cycle(options.sweeps, options.relaxation);
        report.excess = greatest_excess(levels.heights(), levels.limits(), cell_size);
        report.sweeps += 1.0;
        ++report.cycles;
    }
    report.sweeps += levels.passes();
    DoubleRaster heights = levels.heights();
    if (report.excess > options.tolerance) {
        const EnvelopeReport finish = bring_within_limits(heights, levels.limits(), cell_size);
        report.finished_areas = finish.areas;
        report.excess = greatest_excess(heights, levels.limits(), cell_size);
        report.sweeps += finish.passes + 3.0;  // the areas and the mean; the excess
    }
    report.moved_m3 = moved_volume(before, heights, cell_size);
    store_displacement(before, heights, base, displacement);
    return report;
}

SettleReport settle_to_rest(FloatRaster& displacement, const Heightfield& base,
                            const SoilField& soil, const SettleOptions& options) {
    check_heightfield(base);
    SoilTile tile;
    soil.fill({0, 0, base.heights.width(), base.heights.height()}, tile);
    return settle_to_rest(displacement, base, tile, options);
}

}  // namespace scree::terrain
