#include "terrain/grid/slope_envelopes.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <vector>

namespace scree::terrain {

namespace {

constexpr double kTolerance = 1e-9;  // of a cell size

// One pass in one of four orders (fast sweeping): every cell takes the least that a neighbour plus
// the limit between them allows. `sign` -1 does the same for the upper envelope of -heights.
template <int sign>
bool pass(DoubleRaster& envelope, const SlopeLimits& limits, int order, double tolerance) {
    const int width = envelope.width();
    const int height = envelope.height();
    const FloatRaster& rise_x = sign > 0 ? limits.rise_x : limits.fall_x;
    const FloatRaster& fall_x = sign > 0 ? limits.fall_x : limits.rise_x;
    const FloatRaster& rise_z = sign > 0 ? limits.rise_z : limits.fall_z;
    const FloatRaster& fall_z = sign > 0 ? limits.fall_z : limits.rise_z;
    bool changed = false;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const int x = (order & 1) != 0 ? width - 1 - column : column;
            const int y = (order & 2) != 0 ? height - 1 - row : row;
            const double here = sign * envelope(x, y);
            double least = here;
            if (x > 0)
                least = std::min(least, sign * envelope(x - 1, y) + rise_x(x - 1, y));
            if (x + 1 < width)
                least = std::min(least, sign * envelope(x + 1, y) + fall_x(x, y));
            if (y > 0)
                least = std::min(least, sign * envelope(x, y - 1) + rise_z(x, y - 1));
            if (y + 1 < height)
                least = std::min(least, sign * envelope(x, y + 1) + fall_z(x, y));
            if (least < here - tolerance) {
                envelope(x, y) = sign * least;
                changed = true;
            }
        }
    return changed;
}

// Four passes at a time until nothing changes: values only fall, along paths that never repeat.
template <int sign>
int sweep_envelope(DoubleRaster& envelope, const SlopeLimits& limits, double tolerance) {
    int passes = 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (int order = 0; order < 4; ++order)
            changed = pass<sign>(envelope, limits, order, tolerance) || changed;
        passes += 4;
    }
    return passes;
}

struct Cell {
    int x;
    int y;
};

// Cells connected over faces with `start` in which the envelopes differ; marks them as seen.
void gather_area(const DoubleRaster& lower, const DoubleRaster& upper, Cell start, Mask& seen,
                 std::vector<Cell>& area) {
    const auto take = [&](Cell cell) {
        if (!seen.contains(cell.x, cell.y) || seen(cell.x, cell.y) != 0 ||
            !(upper(cell.x, cell.y) > lower(cell.x, cell.y)))
            return;
        seen(cell.x, cell.y) = 1;
        area.push_back(cell);
    };
    area.clear();
    take(start);
    for (std::size_t i = 0; i < area.size(); ++i) {
        const Cell cell = area[i];
        for (const Cell next : {Cell{cell.x - 1, cell.y}, Cell{cell.x + 1, cell.y},
                                Cell{cell.x, cell.y - 1}, Cell{cell.x, cell.y + 1}})
            take(next);
    }
}

void mix_area(const std::vector<Cell>& area, const DoubleRaster& lower, const DoubleRaster& upper,
              DoubleRaster& heights) {
    double wanted = 0.0;  // relative to the lower envelope: small numbers add up without loss
    double range = 0.0;
    for (const auto [x, y] : area) {
        wanted += heights(x, y) - lower(x, y);
        range += upper(x, y) - lower(x, y);
    }
    const double weight = std::clamp(wanted / range, 0.0, 1.0);
    for (const auto [x, y] : area)
        heights(x, y) = lower(x, y) + weight * (upper(x, y) - lower(x, y));
}

}  // namespace

EnvelopeReport bring_within_limits(DoubleRaster& heights, const SlopeLimits& limits,
                                   double cell_size) {
    DoubleRaster lower = heights;
    DoubleRaster upper = heights;
    std::array<int, 2> passes{};
    const double tolerance = kTolerance * cell_size;
    parallel_invoke([&] { passes[0] = sweep_envelope<1>(lower, limits, tolerance); },
                    [&] { passes[1] = sweep_envelope<-1>(upper, limits, tolerance); });

    EnvelopeReport report{.passes = passes[0] + passes[1]};
    Mask seen(heights.width(), heights.height());
    std::vector<Cell> area;
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x) {
            gather_area(lower, upper, {x, y}, seen, area);
            if (area.empty())
                continue;
            mix_area(area, lower, upper, heights);
            ++report.areas;
        }
    return report;
}

}  // namespace scree::terrain
