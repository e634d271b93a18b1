#pragma once

#include "base/progress.h"
#include "terrain/fluid/fluid.h"
#include "terrain/surface/erosion_report.h"
#include "terrain/surface/sediment.h"
#include "terrain/surface/wet_erosion.h"

#include <functional>

namespace scree::terrain {

/// What the water does to the surface.
enum class ErosionScheme {
    Wear,      ///< Curvature-driven wear; what is worn off vanishes (`mesh-erosion.md` 7).
    Sediment,  ///< Shear stress takes up sediment, which settles elsewhere (`mesh-erosion.md` 8).
};
inline constexpr std::string_view kErosionSchemeNames[] = {"wear", "sediment"};
constexpr std::span<const std::string_view> names_of(ErosionScheme) {
    return kErosionSchemeNames;
}

/// How a run goes on.
struct ErosionLoopOptions {
    int steps = 100;                  ///< At the first step limit; shorter ones need more.
    double frame_seconds = 1.0 / 30;  ///< Of the fluid, in one step.
    int warm_up = 0;                  ///< Frames of the fluid before the first step.
    ErosionScheme scheme = ErosionScheme::Wear;
    int check_every = 10;      ///< Steps between two looks for self-intersections; 0 never looks.
    double shorten = 2.0;      ///< The step limit grows by this after a tangle.
    int max_restarts = 6;      ///< Tangles after which a run stops.
    bool keep_dose = true;     ///< After a tangle take more steps, so that as much is worn.
    bool small_faces = false;  ///< Collapse edges below a tenth of the mean after every step.
    double cosmetic_noise = 0.0;  ///< Of the mesh at the start, to either side, mean edges.
    double weathering = 0.0;  ///< Share of a step of weathering that follows each step of water.
};

template <class Visitor>
void describe(ErosionLoopOptions& o, Visitor&& field) {
    field("steps", o.steps, {.min = 0, .max = 1e6, .help = "steps of erosion"});
    field("frame-seconds", o.frame_seconds,
          {.min = 1e-6, .max = 1e3, .unit = "s", .help = "of the fluid, in one step"});
    field("warm-up", o.warm_up,
          {.min = 0, .max = 1e6, .help = "frames of the fluid before the first step"});
    field("scheme", o.scheme, {.help = "what the water does to the surface"});
    field("check-every", o.check_every,
          {.min = 0, .max = 1e6, .help = "steps between looks for self-intersections; 0 for none"});
    field("shorten", o.shorten,
          {.min = 1.1, .max = 100, .help = "the step limit grows by this after a tangle"});
    field("max-restarts", o.max_restarts,
          {.min = 0, .max = 30, .help = "tangles after which a run stops"});
    field("keep-dose", o.keep_dose, {.help = "after a tangle take more, shorter steps"});
    field("small-faces", o.small_faces, {.help = "collapse small faces after every step"});
    field("cosmetic-noise", o.cosmetic_noise,
          {.min = 0, .max = 0.5, .help = "roughness of the mesh at the start, mean edges"});
    field("weathering", o.weathering,
          {.min = 0, .max = 1, .help = "share of a weathering step after each step of water"});
}

/// A run that can be stopped and taken up again: everything that the next step depends on.
struct ErosionRun {
    meshing::TriMesh mesh;
    FluidState fluid;
    SedimentState sediment;
    double step_limit = 0.0;  ///< 0 before the first step.
    double dose = 0.0;        ///< Sum of one over the step limits.
    int warmed_up = 0;        ///< Frames.
    bool sound = true;        ///< A run taken up from here ends as one that never stopped.
    ErosionReport report;
};

/// What a run calls; everything may be empty.
struct ErosionHooks {
    /// After every step, also those that are rolled back later.
    std::function<void(const ErosionRun& run)> after_step = {};
    /// Pairs of triangles that cross; without it meshing's own search.
    std::function<std::size_t(const meshing::TriMesh& mesh)> count_crossings = {};
    Progress* progress = nullptr;
};

/// Steps of fluid and erosion in turn (`mesh-erosion.md` 13), until the dose of `steps` at the
/// first step limit is given.
///
/// Self-intersections that were not there at the start are rolled back to the last state that was
/// looked at, and shorter steps are taken from there; a run that tangles too often ends at that
/// state, with `finished` false.
/// @param fluid  Takes the run's fluid state if that has particles or time, else gives it.
/// @post  `run` holds the result; given to another call it goes on to the same end.
/// @throw InvalidOption  a value is out of its range, or small faces shall be collapsed under
///                       sediment, which is kept by vertex.
/// @throw InvalidInput, Cancelled  the first also if particles reach no farther than their radius.
void run_erosion(ErosionRun& run, ParticleFluid& fluid, const ErosionLoopOptions& loop,
                 const WetErosionOptions& wet, const SedimentOptions& sediment,
                 const ErosionHooks& hooks = {});

}  // namespace scree::terrain
