#pragma once

#include "base/options.h"

namespace scree::terrain {

/// How one material moves. The defaults are dry sand (`rocks-and-deformer.md` C.9; the source
/// gives no figures).
struct Soil {
    double repose_deg = 34.0;  ///< Angle of repose: steepest slope that holds, degrees.
    double mobility = 0.5;     ///< Inverse friction: how far a force pushes it; grid units.
    double diffusion = 0.2;    ///< D * dt / dx^2: share of a height difference in one iteration.
    double compaction = 0.0;   ///< Share of what a load penetrates, times mobility, that is pressed
                               ///< together in one iteration and lost (C.8).

    bool operator==(const Soil&) const = default;
};

inline constexpr Soil kSand{.repose_deg = 34.0, .mobility = 0.5, .diffusion = 0.20};
inline constexpr Soil kMud{.repose_deg = 15.0, .mobility = 0.25, .diffusion = 0.08};
inline constexpr Soil kPebbles{.repose_deg = 38.0, .mobility = 0.8, .diffusion = 0.12};

template <class Visitor>
void describe(Soil& o, Visitor&& field) {
    field("repose", o.repose_deg,
          {.min = 0, .max = 89, .unit = "deg", .help = "steepest slope that holds"});
    field("mobility", o.mobility,
          {.min = 0, .max = 16, .help = "how far a force pushes it (inverse friction)"});
    field("diffusion", o.diffusion,
          {.min = 0, .max = 4, .help = "share of a height difference moved in one iteration"});
    field("compaction", o.compaction,
          {.min = 0, .max = 1, .help = "share of the pushed volume that is pressed together"});
}

}  // namespace scree::terrain
