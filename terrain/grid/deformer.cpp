#include "terrain/grid/deformer.h"

#include "base/error.h"
#include "terrain/grid/literal_ground.h"
#include "terrain/grid/sound_ground.h"
#include "terrain/grid/whole_quanta.h"

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

void check_window(const CellWindow& window, const CellWindow& extent) {
    if (window.width < 0 || window.height < 0 ||
        (!window.empty() && intersection(window, extent) != window))
        fail<InvalidInput>("the window of ", window.width, " x ", window.height, " cells at (",
                           window.x, ", ", window.y, ") reaches outside the ground of ",
                           extent.width, " x ", extent.height, " cells");
}

/// Beyond these the arithmetic in float could overflow.
void check_range(const Heightfield& base) {
    constexpr float kGreatest = 1e9F;
    for (const float height : base.heights)
        if (std::fabs(height) > kGreatest)
            fail<InvalidInput>("the ground has a height of ", height,
                               " m, heights must be within 1e9 m");
}

}  // namespace

struct Deformer::State {
    State(const Heightfield& heightfield, const SoilField& soil, const DeformerOptions& options)
        : base(&heightfield) {
        if (options.reading == Reading::Sound)
            sound = std::make_unique<SoundGround>(heightfield, soil, options);
        else
            literal = std::make_unique<LiteralGround>(heightfield, soil, options);
    }

    DeformerReport step(std::span<const Load> loads, float* moved) {
        return sound ? sound->step(loads, moved) : literal->step(loads, moved);
    }

    const Heightfield* base;
    std::unique_ptr<SoundGround> sound;  ///< One of the two, by the reading.
    std::unique_ptr<LiteralGround> literal;
};

Deformer::Deformer(const Heightfield& base, const SoilField& soil, const DeformerOptions& options) {
    check(options);
    check_heightfield(base);
    check_range(base);
    check_stability(soil, options);
    state_ = std::make_unique<State>(base, soil, options);
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

DeformerReport Deformer::step(std::span<const Load> loads) {
    for (const Load& load : loads)
        check_load(load);
    return state_->step(loads, nullptr);
}

DeformerReport Deformer::settle(int max_frames, double tolerance_m) {
    DeformerReport report;
    for (int frame = 0; frame < max_frames; ++frame) {
        float moved = 0.0F;
        report = state_->step({}, &moved);
        report.at_rest = report.at_rest || double{moved} <= tolerance_m;
        if (report.at_rest)
            break;
    }
    return report;
}

void Deformer::replace_displacement(const FloatRaster& displacement) {
    check_displacement(displacement, extent().width, extent().height);
    if (state_->sound)
        state_->sound->replace(displacement);
    else
        state_->literal->replace(displacement);
}

FloatRaster Deformer::displacement(const CellWindow& window) const {
    check_window(window, extent());
    FloatRaster result(window.width, window.height);
    if (state_->sound)
        state_->sound->store().read(window, result.data(), window.width);
    else
        state_->literal->read_displacement(window, result);
    return result;
}

FloatRaster Deformer::heights(const CellWindow& window) const {
    FloatRaster result = displacement(window);
    for (int y = 0; y < window.height; ++y) {
        const float* base = state_->base->heights.row(window.y + y) + window.x;
        float* row = result.row(y);
        for (int x = 0; x < window.width; ++x)
            row[x] += base[x];
    }
    return result;
}

CellWindow Deformer::extent() const {
    return {0, 0, state_->base->heights.width(), state_->base->heights.height()};
}

double Deformer::cell_size() const {
    return state_->base->cell_size;
}

double Deformer::displaced_volume() const {
    const double sum = state_->sound ? state_->sound->store().sum() : state_->literal->sum();
    return sum * cell_size() * cell_size();
}

std::size_t Deformer::bytes() const {
    return state_->sound ? state_->sound->bytes() : state_->literal->bytes();
}

}  // namespace scree::terrain
