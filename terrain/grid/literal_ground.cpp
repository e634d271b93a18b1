#include "terrain/grid/literal_ground.h"

#include "base/parallel.h"
#include "base/simd.h"
#include "terrain/grid/literal_terms.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {
namespace {

struct RowSoil {
    float repose, per_room, diffusion;
};

struct RowScale {
    float to_grid, time_step, push;
    bool clamp_weights, chain_rule;
};

/// Rows of the general case, each with readable cells before and after.
struct RowInputs {
    const float *above, *here, *below;
    const float *force_x, *force_z, *force_above, *force_below;
    const float* repose;
    const float *diffusion, *diffusion_below;
    const float *mobility, *mobility_above, *mobility_below;
};

/// @tparam kUnit  Cell size and time step are 1, which leaves two factors out.
template <bool kClamp, bool kUnit>
[[gnu::always_inline]] inline void uniform_row(const float* above, const float* here,
                                               const float* below, int n, const RowSoil& soil,
                                               const RowScale& scale, float* __restrict out) {
    const RowSoil s = soil;
    const RowScale c = scale;
    for (int x = 0; x < n; ++x) {
        const float term_x = literal_diffusion(here[x - 1], here[x], here[x + 1], s.diffusion);
        const float term_z = literal_diffusion(above[x], here[x], below[x], s.diffusion);
        const float sum = literal_product(term_x, term_z, {s.repose, s.per_room, kClamp},
                                          kUnit ? 1.0F : c.to_grid);
        out[x] = here[x] + (kUnit ? 1.0F : c.time_step) * sum;
    }
}

SCREE_MULTIVERSION void row_plain(const float* above, const float* here, const float* below, int n,
                                  const RowSoil& soil, const RowScale& scale, float* out) {
    const bool unit = scale.to_grid == 1.0F && scale.time_step == 1.0F;
    if (unit)
        uniform_row<false, true>(above, here, below, n, soil, scale, out);
    else
        uniform_row<false, false>(above, here, below, n, soil, scale, out);
}
SCREE_MULTIVERSION void row_clamped(const float* above, const float* here, const float* below,
                                    int n, const RowSoil& soil, const RowScale& scale, float* out) {
    uniform_row<true, false>(above, here, below, n, soil, scale, out);
}

SCREE_MULTIVERSION void row_general(const RowInputs& inputs, int n, const RowScale& scale,
                                    float* __restrict out) {
    const RowInputs in = inputs;
    const RowScale c = scale;
    for (int x = 0; x < n; ++x) {
        float term_x =
            literal_diffusion(in.here[x - 1], in.here[x], in.here[x + 1], in.diffusion[x]) +
            literal_push(in.force_x[x - 1], in.force_x[x + 1], in.mobility[x], c.push);
        float term_z = literal_diffusion(in.above[x], in.here[x], in.below[x], in.diffusion[x]) +
                       literal_push(in.force_above[x], in.force_below[x], in.mobility[x], c.push);
        if (c.chain_rule) {
            term_x += (in.here[x + 1] - in.here[x]) * (in.diffusion[x + 1] - in.diffusion[x]);
            term_x += literal_push(in.mobility[x - 1], in.mobility[x + 1], in.force_x[x], c.push);
            term_z += (in.below[x] - in.here[x]) * (in.diffusion_below[x] - in.diffusion[x]);
            term_z +=
                literal_push(in.mobility_above[x], in.mobility_below[x], in.force_z[x], c.push);
        }
        const float repose = in.repose[x];
        const float sum = literal_product(
            term_x, term_z, {repose, literal_room(repose), c.clamp_weights}, c.to_grid);
        out[x] = in.here[x] + c.time_step * sum;
    }
}

RowScale scale_of(const LiteralRule& rule) {
    return {.to_grid = rule.steps * rule.steps / rule.cell_size,
            .time_step = rule.time_step,
            .push = (rule.plus_sign ? 1.0F : -1.0F) * (rule.half ? 0.5F : 1.0F) * rule.cell_size,
            .clamp_weights = rule.clamp_weights,
            .chain_rule = rule.terms == LiteralTerms::ChainRule};
}

/// Parameters of one cell more on every side: outside the grid those of its rim.
SoilTile soil_with_rim(const SoilField& field, int width, int height) {
    SoilTile inside, tile;
    field.fill({0, 0, width, height}, inside);
    const auto widened = [&](const FloatRaster& plane) {
        FloatRaster result(width + 2, height + 2);
        for (int y = 0; y < height + 2; ++y)
            for (int x = 0; x < width + 2; ++x)
                result(x, y) =
                    plane(std::clamp(x - 1, 0, width - 1), std::clamp(y - 1, 0, height - 1));
        return result;
    };
    tile.repose = widened(inside.repose);
    tile.diffusion = widened(inside.diffusion);
    tile.mobility = widened(inside.mobility);
    return tile;
}

}  // namespace

LiteralGround::LiteralGround(const Heightfield& base, const SoilField& soil,
                             const DeformerOptions& options)
    : base_(&base),
      rule_(literal_rule(base, options)),
      iterations_(options.iterations),
      width_(base.heights.width()),
      height_(base.heights.height()),
      uniform_(soil.map().ids.empty()),
      heights_(width_, height_),
      next_(width_, height_) {
    if (uniform_)
        soil.fill({0, 0, 1, 1}, soil_);
    else
        soil_ = soil_with_rim(soil, width_, height_);
    for (int y = 0; y < height_; ++y) {
        float* row = heights_.row(y);
        std::copy_n(base.heights.row(y), width_, row);
        row[-1] = row[0];
        row[width_] = row[width_ - 1];
    }
    copy_rim_rows(heights_);
}

DeformerReport LiteralGround::step(std::span<const Load> loads, float* moved) {
    gather(loads);
    if (moved)
        *moved = 0.0F;
    DeformerReport report{.tiles_stepped = 1};
    for (int i = 0; i < iterations_; ++i) {
        iterate();
        std::swap(heights_, next_);
        if (moved) {
            float greatest = 0.0F;
            for (int y = 0; y < height_; ++y)
                for (int x = 0; x < width_; ++x)
                    greatest = std::max(greatest, std::fabs(heights_.row(y)[x] - next_.row(y)[x]));
            *moved += greatest;
        }
    }
    for (int y = 0; y < height_ && report.at_rest; ++y)
        report.at_rest = std::equal(heights_.row(y), heights_.row(y) + width_, next_.row(y));
    return report;
}

void LiteralGround::gather(std::span<const Load> loads) {
    loaded_ = !loads.empty();
    if (!loaded_)
        return;
    if (uniform_ && soil_.repose.size() == 1) {  // the general row reads planes
        const auto spread = [&](FloatRaster& plane) {
            plane = FloatRaster(width_ + 2, height_ + 2, plane(0, 0));
        };
        spread(soil_.repose);
        spread(soil_.diffusion);
        spread(soil_.mobility);
    }
    force_x_ = FloatRaster(width_ + 2, height_ + 2);
    force_z_ = FloatRaster(width_ + 2, height_ + 2);
    for (const Load& load : loads) {
        const CellWindow part = intersection(load.window, {0, 0, width_, height_});
        for (int y = part.y; y < part.y + part.height; ++y)
            for (int x = part.x; x < part.x + part.width; ++x) {
                const int lx = x - load.window.x;
                const int ly = y - load.window.y;
                force_x_(x + 1, y + 1) += load.force_x(lx, ly);
                force_z_(x + 1, y + 1) += load.force_z(lx, ly);
            }
    }
}

void LiteralGround::iterate() {
    constexpr std::size_t kRows = 32;
    parallel_for_each_index(0, static_cast<std::size_t>(height_), kRows,
                            [&](std::size_t y) { step_row(static_cast<int>(y)); });
    copy_rim_rows(next_);
}

/// One row, and its rim while it is at hand.
void LiteralGround::step_row(int y) {
    step_cells(y);
    float* row = next_.row(y);
    if (rule_.border == Border::Zero) {  // (4.7)
        const float* base = base_->heights.row(y);
        if (y == 0 || y == height_ - 1)
            std::copy_n(base, width_, row);
        row[0] = base[0];
        row[width_ - 1] = base[width_ - 1];
    }
    row[-1] = row[0];
    row[width_] = row[width_ - 1];
}

void LiteralGround::step_cells(int y) {
    const float* here = heights_.row(y);
    const float* above = heights_.row(y - 1);
    const float* below = heights_.row(y + 1);
    float* out = next_.row(y);
    const RowScale scale = scale_of(rule_);
    if (uniform_ && !loaded_) {
        const float repose = soil_.repose(0, 0);
        const RowSoil soil{repose, literal_room(repose), soil_.diffusion(0, 0)};
        (rule_.clamp_weights ? row_clamped : row_plain)(above, here, below, width_, soil, scale,
                                                        out);
        return;
    }
    const std::vector<float> none(loaded_ ? 0 : static_cast<std::size_t>(width_) + 2);
    const auto force = [&](const FloatRaster& forces, int row) {
        return (loaded_ ? forces.row(row) : none.data()) + 1;
    };
    row_general(
        {above, here, below, force(force_x_, y + 1), force(force_z_, y + 1), force(force_z_, y),
         force(force_z_, y + 2), soil_.repose.row(y + 1) + 1, soil_.diffusion.row(y + 1) + 1,
         soil_.diffusion.row(y + 2) + 1, soil_.mobility.row(y + 1) + 1, soil_.mobility.row(y) + 1,
         soil_.mobility.row(y + 2) + 1},
        width_, scale, out);
}

/// Cells outside the ground have the height of its rim.
void LiteralGround::copy_rim_rows(RimmedRows& heights) const {
    std::copy_n(heights.row(0) - 1, width_ + 2, heights.row(-1) - 1);
    std::copy_n(heights.row(height_ - 1) - 1, width_ + 2, heights.row(height_) - 1);
}

void LiteralGround::replace(const FloatRaster& displacement) {
    for (int y = 0; y < height_; ++y) {
        float* row = heights_.row(y);
        for (int x = 0; x < width_; ++x)
            row[x] = base_->heights(x, y) + displacement(x, y);
        row[-1] = row[0];
        row[width_] = row[width_ - 1];
    }
    copy_rim_rows(heights_);
}

void LiteralGround::read_displacement(const CellWindow& window, FloatRaster& out) const {
    for (int y = 0; y < window.height; ++y) {
        const float* base = base_->heights.row(window.y + y) + window.x;
        const float* heights = heights_.row(window.y + y) + window.x;
        float* row = out.row(y);
        for (int x = 0; x < window.width; ++x)
            row[x] = heights[x] - base[x];
    }
}

double LiteralGround::sum() const {
    double sum = 0.0;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            sum += double{heights_.row(y)[x]} - base_->heights(x, y);
    return sum;
}

std::size_t LiteralGround::bytes() const {
    return (2 * RimmedRows::size(width_, height_) + force_x_.size() + force_z_.size() +
            3 * soil_.repose.size()) *
           sizeof(float);
}

}  // namespace scree::terrain
