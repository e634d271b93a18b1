#include "terrain/grid/deformer.h"

#include "base/error.h"
#include "terrain/grid/sound_step.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {
namespace {

void check_stability(const SoilField& soil, const DeformerOptions& options) {
    const double bound = options.slide == Slide::Gain ? 0.125 : 0.25;
    const double step = soil.greatest_diffusion() * options.time_step;
    if (options.reading == Reading::Sound && step > bound * (1.0 + 1e-6))
        fail<InvalidOption>("time-step is ", options.time_step, " and the largest diffusion ",
                            soil.greatest_diffusion(), ": their product ", step,
                            " is beyond the stability bound ", bound, ", lower one of them");
}

}  // namespace

struct Deformer::State {
    const Heightfield* base;
    SoilTile soil;
    DeformerOptions options;
    SoundRule rule;
    FloatRaster displacement;
};

Deformer::Deformer(const Heightfield& base, const SoilField& soil, const DeformerOptions& options) {
    check(options);
    check_heightfield(base);
    check_stability(soil, options);
    state_ = std::make_unique<State>();
    state_->base = &base;
    state_->options = options;
    state_->rule = sound_rule(base, options);
    state_->displacement = FloatRaster(base.heights.width(), base.heights.height());
    soil.fill(extent(), state_->soil);
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

DeformerReport Deformer::step(std::span<const Load> loads) {
    for (const Load& load : loads)
        check_load(load);
    DeformerReport report{.tiles_stepped = 1};
    for (int i = 0; i < state_->options.iterations; ++i) {
        SoundStep next =
            sound_step(*state_->base, state_->soil, loads, state_->displacement, state_->rule);
        report.compacted_m3 += next.compacted_m3;
        report.at_rest = next.displacement == state_->displacement;
        state_->displacement = std::move(next.displacement);
    }
    return report;
}

DeformerReport Deformer::settle(int max_frames, double tolerance_m) {
    DeformerReport report;
    for (int frame = 0; frame < max_frames; ++frame) {
        const FloatRaster before = state_->displacement;
        report = step({});
        double moved = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i)
            moved = std::max(moved,
                             std::fabs(double{state_->displacement.data()[i]} - before.data()[i]));
        report.at_rest = moved <= tolerance_m;
        if (report.at_rest)
            break;
    }
    return report;
}

FloatRaster Deformer::displacement(const CellWindow& window) const {
    FloatRaster result(window.width, window.height);
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x)
            result(x, y) = state_->displacement(window.x + x, window.y + y);
    return result;
}

FloatRaster Deformer::heights(const CellWindow& window) const {
    FloatRaster result = displacement(window);
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x)
            result(x, y) += state_->base->heights(window.x + x, window.y + y);
    return result;
}

CellWindow Deformer::extent() const {
    return {0, 0, state_->base->heights.width(), state_->base->heights.height()};
}

double Deformer::cell_size() const {
    return state_->base->cell_size;
}

double Deformer::displaced_volume() const {
    double sum = 0.0;
    for (const float u : state_->displacement)
        sum += u;
    return sum * cell_size() * cell_size();
}

std::size_t Deformer::bytes() const {
    return state_->displacement.size() * sizeof(float);
}

}  // namespace scree::terrain
