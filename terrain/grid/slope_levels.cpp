#include "terrain/grid/slope_levels.h"

#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>

namespace scree::terrain {

namespace {

constexpr int kLeastSide = 8;  // grids with a shorter side are not made coarser
constexpr std::size_t kRows = 32;

// Height that a face must hand from its second cell to its first. At most one term is not zero.
double handed(double difference, double rise, double fall) {
    return std::max(difference - rise, 0.0) + std::min(difference + fall, 0.0);
}

SCREE_MULTIVERSION void relax_along_row(double* heights, const float* rise, const float* fall,
                                        int width, double share) {
    for (int first = 0; first < 2; ++first)
        for (int x = first; x + 1 < width; x += 2) {
            const double step = share * handed(heights[x + 1] - heights[x], rise[x], fall[x]);
            heights[x] += step;
            heights[x + 1] -= step;
        }
}

SCREE_MULTIVERSION void relax_rows(double* upper, double* lower, const float* rise,
                                   const float* fall, int width, double share) {
    for (int x = 0; x < width; ++x) {
        const double step = share * handed(lower[x] - upper[x], rise[x], fall[x]);
        upper[x] += step;
        lower[x] -= step;
    }
}

// Faces in four groups of which no two share a cell: any order inside a group gives the same bytes.
void relax(DoubleRaster& heights, const SlopeLimits& limits, double share) {
    const int width = heights.width();
    const auto height = static_cast<std::size_t>(heights.height());
    parallel_for_each_index(0, height, kRows, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        relax_along_row(heights.row(y), limits.rise_x.row(y), limits.fall_x.row(y), width, share);
    });
    for (std::size_t first = 0; first < 2; ++first)
        parallel_for_each_index(0, (height - first) / 2, kRows, [&](std::size_t pair) {
            const int y = static_cast<int>(2 * pair + first);
            relax_rows(heights.row(y), heights.row(y + 1), limits.rise_z.row(y),
                       limits.fall_z.row(y), width, share);
        });
}

// Mean over the four paths of two faces each that lead from a block of cells to the next.
FloatRaster coarse_limit(const FloatRaster& fine, int along_x, int along_y) {
    FloatRaster coarse(fine.width() / 2, fine.height() / 2);
    for (int y = 0; y + along_y < coarse.height(); ++y)
        for (int x = 0; x + along_x < coarse.width(); ++x) {
            float sum = 0.0F;
            for (int dy = 0; dy < 2; ++dy)
                for (int dx = 0; dx < 2; ++dx)
                    sum += fine(2 * x + dx, 2 * y + dy) +
                           fine(2 * x + dx + along_x, 2 * y + dy + along_y);
            coarse(x, y) = sum / 4.0F;
        }
    return coarse;
}

void restrict_heights(const DoubleRaster& fine, DoubleRaster& coarse) {
    for (int y = 0; y < coarse.height(); ++y) {
        const double* upper = fine.row(2 * y);
        const double* lower = fine.row(2 * y + 1);
        double* out = coarse.row(y);
        for (int x = 0; x < coarse.width(); ++x)
            out[x] = 0.25 * (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1]);
    }
}

// Bilinear between coarse centres, the rim carried outwards: every coarse cell hands out four times
// its value, whatever its place, so volume is kept.
void add_interpolated(const DoubleRaster& coarse, DoubleRaster& fine) {
    const auto rows = 2 * static_cast<std::size_t>(coarse.height());
    parallel_for_each_index(0, rows, kRows, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const int last = coarse.width() - 1;
        const double* near = coarse.row(y / 2);
        const double* far =
            coarse.row(std::clamp(y / 2 + (y % 2 == 0 ? -1 : 1), 0, coarse.height() - 1));
        const auto value = [&](int x) { return 0.75 * near[x] + 0.25 * far[x]; };
        double* out = fine.row(y);
        for (int x = 0; x <= last; ++x) {
            const double here = 0.75 * value(x);
            out[2 * x] += here + 0.25 * value(std::max(x - 1, 0));
            out[2 * x + 1] += here + 0.25 * value(std::min(x + 1, last));
        }
    });
}

}  // namespace

SlopeLevels::SlopeLevels(DoubleRaster heights, SlopeLimits limits) {
    levels_.push_back({std::move(heights), {}, std::move(limits)});
    while (std::min(levels_.back().heights.width(), levels_.back().heights.height()) >=
           kLeastSide) {
        const Level& fine = levels_.back();
        const DoubleRaster cells(fine.heights.width() / 2, fine.heights.height() / 2);
        const SlopeLimits& of = fine.limits;
        SlopeLimits coarse{coarse_limit(of.rise_x, 1, 0), coarse_limit(of.fall_x, 1, 0),
                           coarse_limit(of.rise_z, 0, 1), coarse_limit(of.fall_z, 0, 1)};
        count(fine, 1.0);
        levels_.push_back({cells, cells, std::move(coarse)});
    }
}

void SlopeLevels::cycle(int sweeps, double relaxation) {
    visit(0, sweeps, relaxation);
}

void SlopeLevels::visit(std::size_t level, int sweeps, double relaxation) {
    Level& here = levels_[level];
    const double share = 0.5 * relaxation;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        relax(here.heights, here.limits, share);
    if (level + 1 < levels_.size()) {
        Level& coarse = levels_[level + 1];
        restrict_heights(here.heights, coarse.heights);
        coarse.correction = coarse.heights;
        visit(level + 1, sweeps, relaxation);
        std::transform(coarse.heights.begin(), coarse.heights.end(), coarse.correction.begin(),
                       coarse.correction.begin(),
                       [](double after, double before) { return after - before; });
        add_interpolated(coarse.correction, here.heights);
        count(here, 1.0);
    }
    for (int sweep = 0; sweep < sweeps; ++sweep)
        relax(here.heights, here.limits, share);
    count(here, 2.0 * sweeps);
}

void SlopeLevels::count(const Level& level, double passes) {
    passes_ += passes * static_cast<double>(level.heights.size()) /
               static_cast<double>(levels_.front().heights.size());
}

}  // namespace scree::terrain
