#pragma once

#include "base/options.h"
#include "terrain/fluid/emitters.h"
#include "terrain/fluid/fluid.h"

#include <cstdint>
#include <memory>

#include <glm/vec3.hpp>

namespace scree::terrain {

struct PositionFluidOptions {
    double radius = 0.05;        ///< Of a particle; neighbours rest two of them apart, metres.
    int iterations = 4;          ///< Of the density constraint in a step.
    double viscosity = 0.05;     ///< Share of the neighbours' mean velocity taken on in a step.
    double friction = 0.1;       ///< Of the mesh: tangential over normal correction.
    int max_substeps = 100;      ///< Most steps that a frame may be divided into.
    int max_particles = 200000;  ///< Emitters pause while there are so many.
    std::int64_t seed = 1;       ///< Of the emitters.
};

template <class Visitor>
void describe(PositionFluidOptions& o, Visitor&& field) {
    field("radius", o.radius, {.min = 1e-6, .max = 1e3, .unit = "m", .help = "of a particle"});
    field("iterations", o.iterations,
          {.min = 1, .max = 100, .help = "of the density constraint in a step"});
    field("viscosity", o.viscosity,
          {.min = 0, .max = 0.5, .help = "share of the neighbours' velocity taken on in a step"});
    field("friction", o.friction, {.min = 0, .max = 1, .help = "of the mesh"});
    field("max-substeps", o.max_substeps,
          {.min = 1, .max = 10000, .help = "most steps that a frame may be divided into"});
    field("max-particles", o.max_particles,
          {.min = 1, .max = 5e6, .help = "emitters pause while there are so many"});
    field("seed", o.seed, {.min = 0, .max = 9e15, .help = "seed of the emitters"});
}

/// Everything a fluid is made of.
struct PositionFluidSetup {
    PositionFluidOptions options;
    glm::vec3 gravity{0.0F, -9.81F, 0.0F};  ///< Metres a second squared; zero is fine.
    FluidBox domain{glm::vec3(-100.0F), glm::vec3(100.0F)};  ///< What leaves it is dropped.
    FluidEmitters emitters;
};

/// Incompressible particles by position-based constraints (`mesh-erosion.md` 8.2's kernels;
/// density constraint after Macklin and Mueller 2013).
///
/// A frame is divided until nothing moves by more than 0.8 spacings in a step. Density is held
/// from above only, so water breaks up into drops; the mesh counts as filled with water at rest.
/// Centres never pass from a triangle's front to its back, and are held a radius away. Sums run
/// over neighbours in the order of their cells: the same bytes for any number of threads.
class PositionFluid final : public ParticleFluid {
public:
    /// @throw InvalidOption, InvalidInput  check_emitters() refuses the emitters, gravity is not
    ///        finite, or the domain has no inside.
    explicit PositionFluid(PositionFluidSetup setup);
    ~PositionFluid() override;

    /// @throw InvalidInput  also if a source's whole opening lies inside the mesh.
    void set_mesh(const meshing::TriMesh& mesh) override;
    int step(double seconds) override;
    const FluidState& state() const override;
    void restore(const FluidState& state) override;

private:
    struct Solver;
    std::unique_ptr<Solver> solver_;
};

}  // namespace scree::terrain
