#pragma once

#include "base/options.h"
#include "terrain/grid/heightfield.h"
#include "terrain/grid/soil_field.h"

namespace scree::terrain {

/// How ground is brought to rest.
struct SettleOptions {
    bool keep_base = true;     ///< Undisturbed ground steeper than its repose stays (C.7).
    int cycles = 8;            ///< Most V-cycles before the envelopes finish the work.
    int sweeps = 4;            ///< Passes on a level, before and after the coarser ones.
    double relaxation = 1.3;   ///< Share of a face's excess that a pass moves.
    double tolerance = 0.001;  ///< Slope over its limit that counts as at rest.
};

template <class Visitor>
void describe(SettleOptions& o, Visitor&& field) {
    field("keep-base", o.keep_base, {.help = "undisturbed steep ground stays where it is"});
    field("cycles", o.cycles, {.min = 0, .max = 1000, .help = "most V-cycles"});
    field("sweeps", o.sweeps, {.min = 1, .max = 64, .help = "passes on a level, each way"});
    field("relaxation", o.relaxation,
          {.min = 0.1, .max = 1.9, .help = "share of a face's excess that a pass moves"});
    field("tolerance", o.tolerance,
          {.min = 1e-6, .max = 1, .help = "slope over its limit that counts as at rest"});
}

/// What settling did.
struct SettleReport {
    double sweeps = 0.0;       ///< Passes over the grid, coarse ones counted by their cells.
    int cycles = 0;            ///< V-cycles.
    int finished_areas = 0;    ///< Areas that the envelopes finished.
    double excess_before = 0;  ///< Slope by which the steepest face exceeded its limit.
    double excess = 0;         ///< The same afterwards; at most the tolerance.
    double moved_m3 = 0.0;     ///< Volume that lies elsewhere than before.
};

/// Let soil slide until every face holds: at once, where the explicit scheme needs thousands of
/// steps.
///
/// A rest state of the slides of `rocks-and-deformer.md` C.8: no slope is steeper than the repose
/// of its higher cell, and the volume is kept. Nothing leaves over the rim. The way there is not a
/// motion in time. The same bytes for any number of threads.
///
/// @pre   displacement has the base's size, its values are finite.
/// @post  The sum of the displacement is kept to float rounding; excess <= tolerance.
/// @throw InvalidOption  a value is out of range.
/// @throw InvalidInput   the base, the displacement or the soil breaks the precondition.
SettleReport settle_to_rest(FloatRaster& displacement, const Heightfield& base,
                            const SoilField& soil, const SettleOptions& options = {});

/// The same on a window cut from a larger ground, with the soils of its cells.
SettleReport settle_to_rest(FloatRaster& displacement, const Heightfield& base,
                            const SoilTile& soil, const SettleOptions& options = {});

}  // namespace scree::terrain
