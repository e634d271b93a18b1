#pragma once

#include "base/options.h"
#include "terrain/fluid/fluid.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// Particles that drift along a path abreast, evenly scattered over its cross-section.
struct ScriptedStream {
    std::vector<glm::vec3> path;  ///< Corners of a line, at least two, metres.
    double speed = 1.0;           ///< Along the path, metres a second.
    double half_width = 0.5;      ///< Level, to both sides of the path, metres.
    double half_height = 0.1;     ///< Above and below the path, metres.
    double per_metre = 20.0;      ///< Particles on a metre of path.
};

struct ScriptedFluidOptions {
    double radius = 0.05;   ///< Of a particle, metres.
    std::int64_t seed = 1;  ///< Of the scatter.
};

template <class Visitor>
void describe(ScriptedFluidOptions& o, Visitor&& field) {
    field("radius", o.radius, {.min = 1e-6, .max = 1e3, .unit = "m", .help = "of a particle"});
    field("seed", o.seed, {.min = 0, .max = 9e15, .help = "seed of the scatter"});
}

/// Particles that go where they are told, whatever the mesh does: full streams from the start,
/// new ones at their heads, gone at their ends (counted as having left).
///
/// Where each is follows from the time alone. One within the contact distance of the surface, on
/// either side, touches it; one deeper in the solid waits there for the bank to come back to it.
class ScriptedFluid final : public ParticleFluid {
public:
    /// @throw InvalidOption, InvalidInput  a stream has no length, or a number is not finite or out
    ///        of range, or all streams together hold more than five million particles.
    ScriptedFluid(std::vector<ScriptedStream> streams, const ScriptedFluidOptions& options = {});
    ~ScriptedFluid() override;

    void set_mesh(const meshing::TriMesh& mesh) override;
    int step(double seconds) override;
    const FluidState& state() const override;
    /// Only the time and which particles are left are taken from a state; a particle that was taken
    /// out stays out.
    /// @throw InvalidInput  also if the state has a particle that the streams do not have.
    void restore(const FluidState& state) override;

private:
    struct Script;
    std::unique_ptr<Script> script_;
};

}  // namespace scree::terrain
