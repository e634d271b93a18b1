#pragma once

#include "base/options.h"
#include "terrain/fluid/position_fluid.h"
#include "terrain/fluid/scripted_fluid.h"
#include "terrain/surface/erosion_ground.h"
#include "terrain/surface/erosion_loop.h"
#include "terrain/surface/sediment.h"
#include "terrain/surface/wet_erosion.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// Which fluid a scene has.
enum class FluidKind {
    Particles,  ///< Water that is simulated.
    Scripted,   ///< Streams that go where they are told.
};
inline constexpr std::string_view kFluidKindNames[] = {"particles", "scripted"};
constexpr std::span<const std::string_view> names_of(FluidKind) {
    return kFluidKindNames;
}

/// What steps.csv says of every step.
enum class StepCsv {
    None,     ///< There is no such file.
    Figures,  ///< The same bytes on every run.
    Times,    ///< Milliseconds besides.
};
inline constexpr std::string_view kStepCsvNames[] = {"none", "figures", "times"};
constexpr std::span<const std::string_view> names_of(StepCsv) {
    return kStepCsvNames;
}

/// What a run of a scene writes.
struct ErosionOutput {
    int mesh_every = 0;        ///< Steps between two meshes of the sequence; 0 writes none.
    int particles_every = 0;   ///< Steps between two frames of particles; 0 writes none.
    int checkpoint_every = 0;  ///< Steps between two checkpoints; 0 writes none.
    bool morph = true;         ///< A GLB that goes from the first shape to the last.
    bool pictures = true;      ///< Before and after.
    StepCsv csv = StepCsv::Figures;
    int width = 900;          ///< Of a picture, px.
    double azimuth = 35.0;    ///< Of the eye, deg.
    double elevation = 35.0;  ///< Of the eye, deg.
};

template <class Visitor>
void describe(ErosionOutput& o, Visitor&& field) {
    field("mesh-every", o.mesh_every,
          {.min = 0, .max = 1e6, .help = "steps between two meshes; 0 writes none"});
    field("particles-every", o.particles_every,
          {.min = 0, .max = 1e6, .help = "steps between two frames of particles; 0 writes none"});
    field("checkpoint-every", o.checkpoint_every,
          {.min = 0, .max = 1e6, .help = "steps between two checkpoints; 0 writes none"});
    field("morph", o.morph, {.help = "a GLB that goes from the first shape to the last"});
    field("pictures", o.pictures, {.help = "pictures before and after"});
    field("csv", o.csv, {.help = "what steps.csv says of every step"});
    field("width", o.width, {.min = 16, .max = 4096, .unit = "px", .help = "of a picture"});
    field("azimuth", o.azimuth, {.min = -360, .max = 360, .unit = "deg", .help = "of the eye"});
    field("elevation", o.elevation, {.min = 10, .max = 89, .unit = "deg", .help = "of the eye"});
}

/// Everything a run of `scree erode` needs.
struct ErosionScene {
    std::string mesh_file;  ///< Relative to the scene's folder; empty for a ground of ours.
    GroundOptions ground;
    FluidKind fluid_kind = FluidKind::Particles;
    PositionFluidSetup water;
    std::vector<ScriptedStream> streams;
    ScriptedFluidOptions script;
    ErosionLoopOptions run;
    WetErosionOptions wear;
    SedimentOptions sediment;
    ErosionOutput output;
};

/// Read a scene (docs/hydraulic-erosion.md). Strict: an unknown member is an error.
/// @param source  What to call the text in messages.
/// @throw InvalidInput  names the source, the place in it and what would be accepted.
ErosionScene erosion_scene_from_json(std::string_view text, const std::string& source);

/// The fluid of a scene.
/// @throw InvalidInput, InvalidOption  the emitters or streams are refused.
std::unique_ptr<ParticleFluid> make_fluid(const ErosionScene& scene);

}  // namespace scree::terrain
