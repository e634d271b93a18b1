#include "terrain/grid/sound_step.h"

#include "base/error.h"
#include "terrain/grid/face_flux.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::terrain {
namespace {

struct Offset {
    int x, y;
};
constexpr Offset kNeighbours[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

/// Everything one iteration reads, cell by cell.
class Step {
public:
    Step(const Heightfield& base, const SoilTile& soil, std::span<const Load> loads,
         const FloatRaster& displacement, const SoundRule& rule)
        : base_(base.heights), soil_(soil), loads_(loads), u_(displacement), rule_(rule) {}

    /// Gain of a cell through its face towards a neighbour, metres; negative for a loss.
    float gain(int x, int y, Offset to) const {
        const int nx = x + to.x;
        const int ny = y + to.y;
        if (!base_.contains(nx, ny))
            return 0.0F;  // no flux through the rim
        return slide(x, y, nx, ny) - pushed(x, y, to) + pushed(nx, ny, {-to.x, -to.y});
    }

    /// Whether the border condition (4.7) holds the cell's displacement at zero.
    bool stays(int x, int y) const {
        return rule_.border == Border::Zero &&
               (x == 0 || y == 0 || x == u_.width() - 1 || y == u_.height() - 1);
    }

    /// Height that is pressed together in a cell: the sink of C.8.
    float compacted(int x, int y) const {
        if (stays(x, y))
            return 0.0F;
        const float share = soil_.compaction(x, y) * soil_.mobility(x, y) * rule_.time_step;
        return quantised(std::min(share, 1.0F) * penetration(x, y), rule_.quantum);
    }

private:
    float slide(int x, int y, int nx, int ny) const {
        const float base_difference = base_(nx, ny) - base_(x, y);
        const float difference = base_difference + (u_(nx, ny) - u_(x, y));
        const bool from_neighbour = difference > 0.0F;
        const int hx = from_neighbour ? nx : x;  // the higher cell is the one that moves
        const int hy = from_neighbour ? ny : y;
        const float held = rule_.keep_base ? std::fabs(base_difference) : 0.0F;
        const float diffusion =
            face_diffusion(soil_.diffusion(x, y), soil_.diffusion(nx, ny)) * rule_.time_step;
        const float quanta =
            rule_.slide == Slide::Excess
                ? excess_slide(difference,
                               std::max(soil_.tan_repose(hx, hy) * rule_.cell_size, held),
                               diffusion, rule_.quantum)
                : quantised(weighted_slide(difference, held, soil_.repose(hx, hy), diffusion,
                                           rule_.per_cell_size, rule_.gain),
                            rule_.quantum);
        return from_neighbour ? quanta : -quanta;
    }

    float force(int x, int y, bool along_x) const {
        float sum = 0.0F;
        for (const Load& load : loads_)
            if (load.window.contains(x, y))
                sum +=
                    (along_x ? load.force_x : load.force_z)(x - load.window.x, y - load.window.y);
        return sum;
    }

    /// Soil between a cell's height and the loads' underside.
    float penetration(int x, int y) const {
        float underside = std::numeric_limits<float>::infinity();
        for (const Load& load : loads_)
            if (load.window.contains(x, y))
                underside =
                    std::min(underside, load.underside(x - load.window.x, y - load.window.y));
        return std::max((base_(x, y) + u_(x, y)) - underside, 0.0F);
    }

    /// What the load would push from a cell into a neighbour, were there no limiter; else 0.
    float outflow(int x, int y, Offset to) const {
        const int nx = x + to.x;
        const int ny = y + to.y;
        if (!base_.contains(nx, ny))
            return 0.0F;
        const bool along_x = to.x != 0;
        const float sense = static_cast<float>(to.x + to.y);
        const float mobility = (soil_.mobility(x, y) + soil_.mobility(nx, ny)) * 0.5F;
        const float face_force = (force(x, y, along_x) + force(nx, ny, along_x)) * 0.5F;
        return std::max(sense * (mobility * face_force) * (rule_.time_step * rule_.cell_size),
                        0.0F);
    }

    /// What the load pushes from a cell into a neighbour (C.9).
    float pushed(int x, int y, Offset to) const {
        if (loads_.empty())
            return 0.0F;
        const float all = (outflow(x, y, kNeighbours[0]) + outflow(x, y, kNeighbours[1])) +
                          (outflow(x, y, kNeighbours[2]) + outflow(x, y, kNeighbours[3]));
        const float room = penetration(x, y) - compacted(x, y);
        return quantised(outflow(x, y, to) * limited_share(room, all), rule_.quantum);
    }

    const FloatRaster& base_;
    const SoilTile& soil_;
    std::span<const Load> loads_;
    const FloatRaster& u_;
    const SoundRule& rule_;
};

float power_of_two_below(double value) {
    return static_cast<float>(std::exp2(std::floor(std::log2(value))));
}

}  // namespace

SoundRule sound_rule(const Heightfield& base, const DeformerOptions& options) {
    double quantum = base.cell_size * std::exp2(-18);
    if (!options.keep_base) {
        const auto [low, high] = std::minmax_element(base.heights.begin(), base.heights.end());
        quantum = std::max(quantum, (double{*high} - double{*low}) * std::exp2(-22));
    }
    return {.slide = options.slide,
            .border = options.border,
            .keep_base = options.keep_base,
            .time_step = static_cast<float>(options.time_step),
            .cell_size = static_cast<float>(base.cell_size),
            .per_cell_size = static_cast<float>(1.0 / base.cell_size),
            .gain = options.slide == Slide::Gain ? 4.0F : 1.0F,
            .quantum = power_of_two_below(quantum)};
}

SoundStep sound_step(const Heightfield& base, const SoilTile& soil, std::span<const Load> loads,
                     const FloatRaster& displacement, const SoundRule& rule) {
    const Step step(base, soil, loads, displacement, rule);
    const int width = displacement.width();
    const int height = displacement.height();
    SoundStep result{.displacement = FloatRaster(width, height)};
    const double cell_area = base.cell_size * base.cell_size;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (step.stays(x, y))
                continue;
            const float sideways =
                step.gain(x, y, kNeighbours[0]) + step.gain(x, y, kNeighbours[1]);
            const float lengthways =
                step.gain(x, y, kNeighbours[2]) + step.gain(x, y, kNeighbours[3]);
            const float compacted = step.compacted(x, y);
            result.displacement(x, y) = displacement(x, y) + ((sideways + lengthways) - compacted);
            result.compacted_m3 += double{compacted} * cell_area;
        }
    return result;
}

void check_load(const Load& load) {
    constexpr float kGreatest = 1e9F;
    constexpr int kFarthest = 1 << 28;
    const CellWindow& window = load.window;
    const bool near = window.x >= -kFarthest && window.x <= kFarthest && window.y >= -kFarthest &&
                      window.y <= kFarthest;
    if (!near)
        fail<InvalidInput>("the load's window begins at (", window.x, ", ", window.y,
                           "), which is far outside any ground");
    for (const FloatRaster* raster : {&load.force_x, &load.force_z, &load.underside})
        if (raster->width() != window.width || raster->height() != window.height)
            fail<InvalidInput>("a raster of the load has ", raster->width(), " x ",
                               raster->height(), " cells, its window has ", window.width, " x ",
                               window.height);
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x) {
            const bool in_range = std::fabs(load.force_x(x, y)) <= kGreatest &&
                                  std::fabs(load.force_z(x, y)) <= kGreatest &&
                                  load.underside(x, y) >= -kGreatest;  // false for NaN
            if (!in_range)
                fail<InvalidInput>("the load's force or underside in cell (", window.x + x, ", ",
                                   window.y + y, ") is no number or beyond 1e9");
        }
}

}  // namespace scree::terrain
