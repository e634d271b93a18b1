#pragma once

#include "base/options.h"
#include "terrain/grid/deformer.h"

namespace scree::terrain {

/// One backward Euler step of the sound slide.
struct ImplicitOptions {
    Slide slide = Slide::Excess;
    double time_step = 10.0;  ///< Times the soils' diffusion; any size is stable.
    bool keep_base = true;    ///< Undisturbed ground steeper than its repose stays (C.7).
    int max_sweeps = 2000;    ///< Passes over the ground.
    double tolerance = 1e-6;  ///< Error of a height, in cell sizes, that counts as solved.
};

template <class Visitor>
void describe(ImplicitOptions& o, Visitor&& field) {
    field("slide", o.slide, {.help = "how soil above its repose slides"});
    field("time-step", o.time_step,
          {.min = 1e-6, .max = 1e6, .help = "of one step; any size is stable"});
    field("keep-base", o.keep_base, {.help = "undisturbed steep ground stays where it is"});
    field("max-sweeps", o.max_sweeps, {.min = 1, .max = 1e6, .help = "passes over the ground"});
    field("tolerance", o.tolerance,
          {.min = 1e-9, .max = 1, .help = "height error, in cell sizes, that counts as solved"});
}

/// How far the solver came.
struct ImplicitReport {
    int sweeps = 0;
    bool converged = false;  ///< If not, the ground was left as it was.
};

/// Let soil slide for one step of any length: the fluxes of `rocks-and-deformer.md` C.8 are those
/// of the ground after the step, so that no step is unstable (the explicit scheme stops at
/// diffusion * time step = 1/4). No loads act; nothing leaves over the rim.
///
/// Heights are solved by relaxation over cells of two colours; the result is the ground before plus
/// the fluxes of the solution, each taken once for both its cells, so that the sum of the
/// displacement is kept whatever the tolerance. The same bytes for any number of threads.
///
/// @pre   displacement has the base's size, its values are finite.
/// @throw InvalidOption  a value is out of range.
/// @throw InvalidInput   the base, the displacement or the soil breaks the precondition.
ImplicitReport implicit_step(FloatRaster& displacement, const Heightfield& base,
                             const SoilField& soil, const ImplicitOptions& options = {});

/// The same on a window cut from a larger ground, with the soils of its cells.
ImplicitReport implicit_step(FloatRaster& displacement, const Heightfield& base,
                             const SoilTile& soil, const ImplicitOptions& options = {});

}  // namespace scree::terrain
