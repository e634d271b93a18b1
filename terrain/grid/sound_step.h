#pragma once

#include "terrain/grid/deformer.h"

namespace scree::terrain {

/// The sound scheme's numbers, as its arithmetic in float takes them.
struct SoundRule {
    Slide slide = Slide::Excess;
    Border border = Border::NoFlux;
    bool keep_base = true;
    float time_step = 1.0F;
    float cell_size = 1.0F;
    float per_cell_size = 1.0F;
    float gain = 1.0F;     ///< 4 for Slide::Gain.
    float quantum = 0.0F;  ///< Every volume that changes cells is a multiple of it, metres.
};

/// The rule for a ground. The quantum is the power of two at 2^-18 cell sizes or just below, so
/// that displacements of up to 64 cell sizes add up exactly; where the base itself may slide it
/// is as much coarser as the span of the base's heights asks.
SoundRule sound_rule(const Heightfield& base, const DeformerOptions& options);

/// Displacements after one iteration, and what was pressed together in it.
struct SoundStep {
    FloatRaster displacement;
    double compacted_m3 = 0.0;
};

/// One iteration of the sound scheme (`rocks-and-deformer.md` C.7 to C.9) over the whole ground,
/// written plainly: every cell visits its four faces. The tiled deformer gives the same bytes.
///
/// Fluxes act on faces: slide by the slope of base plus displacement above the higher cell's
/// repose, or above the base's own slope where that is steeper and `keep_base` is set; and the
/// load's push, mobility and force averaged over the face, which the donor's limiter scales so
/// that no push digs below the load's underside. Under a load the share compaction * mobility *
/// time step of the penetration is pressed together first, and only the rest can be pushed.
///
/// @param soil   Of every cell of the base.
/// @param loads  Forces add up, the lowest underside counts.
SoundStep sound_step(const Heightfield& base, const SoilTile& soil, std::span<const Load> loads,
                     const FloatRaster& displacement, const SoundRule& rule);

/// Throw InvalidInput unless the load's rasters have its window's size and hold forces of at most
/// 1e9 and undersides above -1e9 m.
void check_load(const Load& load);

}  // namespace scree::terrain
