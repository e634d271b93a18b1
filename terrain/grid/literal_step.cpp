#include "terrain/grid/literal_step.h"

#include "terrain/grid/literal_terms.h"

#include <algorithm>

namespace scree::terrain {
namespace {

constexpr int kGroup = 16;

struct Offset {
    int x, y;
};

class Step {
public:
    Step(const SoilTile& soil, std::span<const Load> loads, const LiteralRule& rule, int width,
         int height)
        : soil_(soil), rule_(rule), force_x_(width, height), force_z_(width, height) {
        for (const Load& load : loads) {
            const CellWindow part = intersection(load.window, {0, 0, width, height});
            for (int y = part.y; y < part.y + part.height; ++y)
                for (int x = part.x; x < part.x + part.width; ++x) {
                    const int lx = x - load.window.x;
                    const int ly = y - load.window.y;
                    force_x_(x, y) += load.force_x(lx, ly);
                    force_z_(x, y) += load.force_z(lx, ly);
                }
        }
    }

    /// The new height of a cell (4.10).
    float height(const FloatRaster& heights, int x, int y) const {
        const float repose = soil_.repose(x, y);
        const float to_grid = rule_.steps * rule_.steps / rule_.cell_size;
        const float sum = literal_product(
            term(heights, force_x_, x, y, {1, 0}), term(heights, force_z_, x, y, {0, 1}),
            {repose, literal_room(repose), rule_.clamp_weights}, to_grid);
        return heights(x, y) + rule_.time_step * sum;
    }

private:
    /// d of one axis: (4.9), or (4.13) with the chain rule.
    float term(const FloatRaster& heights, const FloatRaster& force, int x, int y,
               Offset axis) const {
        const int bx = std::max(x - axis.x, 0);
        const int by = std::max(y - axis.y, 0);
        const int ax = std::min(x + axis.x, heights.width() - 1);
        const int ay = std::min(y + axis.y, heights.height() - 1);
        const auto force_at = [&](int cx, int cy) {
            return force.contains(cx, cy) ? force(cx, cy) : 0.0F;
        };
        const float scale =
            (rule_.plus_sign ? 1.0F : -1.0F) * (rule_.half ? 0.5F : 1.0F) * rule_.cell_size;
        float sum = literal_diffusion(heights(bx, by), heights(x, y), heights(ax, ay),
                                      soil_.diffusion(x, y)) +
                    literal_push(force_at(x - axis.x, y - axis.y), force_at(x + axis.x, y + axis.y),
                                 soil_.mobility(x, y), scale);
        if (rule_.terms == LiteralTerms::ChainRule) {
            sum += (heights(ax, ay) - heights(x, y)) *
                   (soil_.diffusion(ax, ay) - soil_.diffusion(x, y));
            sum +=
                literal_push(soil_.mobility(bx, by), soil_.mobility(ax, ay), force_at(x, y), scale);
        }
        return sum;
    }

    const SoilTile& soil_;
    const LiteralRule& rule_;
    FloatRaster force_x_, force_z_;
};

bool on_rim(const FloatRaster& raster, int x, int y) {
    return x == 0 || y == 0 || x == raster.width() - 1 || y == raster.height() - 1;
}

/// Step the cells of a window from `heights` to `next`.
void step_window(const Step& step, const FloatRaster& base, const LiteralRule& rule,
                 const CellWindow& window, const FloatRaster& heights, FloatRaster& next) {
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            next(x, y) = rule.border == Border::Zero && on_rim(base, x, y)
                             ? base(x, y)  // (4.7)
                             : step.height(heights, x, y);
}

}  // namespace

LiteralRule literal_rule(const Heightfield& base, const DeformerOptions& options) {
    return {.terms = options.terms,
            .border = options.border,
            .clamp_weights = options.clamp_weights,
            .plus_sign = options.literal_plus_sign,
            .time_step = static_cast<float>(options.time_step),
            .cell_size = static_cast<float>(base.cell_size)};
}

FloatRaster literal_step(const FloatRaster& base, const SoilTile& soil, std::span<const Load> loads,
                         const FloatRaster& heights, const LiteralRule& rule) {
    const Step step(soil, loads, rule, heights.width(), heights.height());
    FloatRaster next = heights;
    step_window(step, base, rule, {0, 0, heights.width(), heights.height()}, heights, next);
    return next;
}

FloatRaster literal_step_tiled(const FloatRaster& base, const SoilTile& soil,
                               std::span<const Load> loads, const FloatRaster& heights,
                               const LiteralRule& rule, int iterations) {
    const CellWindow extent{0, 0, heights.width(), heights.height()};
    const Step step(soil, loads, rule, heights.width(), heights.height());
    FloatRaster result = heights;
    for (int y = 0; y < extent.height; y += kGroup)
        for (int x = 0; x < extent.width; x += kGroup) {
            const CellWindow group = intersection({x, y, kGroup, kGroup}, extent);
            FloatRaster now = heights;  // outside the group it stays as it was
            FloatRaster next = heights;
            for (int i = 0; i < iterations; ++i) {
                step_window(step, base, rule, group, now, next);
                std::swap(now, next);
            }
            for (int gy = group.y; gy < group.y + group.height; ++gy)
                std::copy_n(now.row(gy) + group.x, group.width, result.row(gy) + group.x);
        }
    return result;
}

}  // namespace scree::terrain
