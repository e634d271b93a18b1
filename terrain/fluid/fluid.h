#pragma once

#include "meshing/mesh/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::terrain {

/// Where a particle touches the mesh.
struct FluidContact {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t triangle = kNone;  ///< Nearest triangle within the contact distance, or kNone.
    float distance = 0.0F;           ///< Signed, metres; negative a little behind the surface.

    bool touching() const { return triangle != kNone; }
    bool operator==(const FluidContact&) const = default;
};

/// What became of all particles so far.
struct FluidTally {
    std::uint64_t emitted = 0;      ///< By emitters.
    std::uint64_t added = 0;        ///< By add_particles().
    std::uint64_t left_domain = 0;  ///< Dropped because they left the domain box.
    std::uint64_t drained = 0;      ///< Taken by sinks.
    std::uint64_t removed = 0;      ///< By remove_particles().
    std::uint64_t blocked = 0;      ///< Not emitted: the place was in the solid or in water.
    std::uint64_t refused = 0;      ///< Not emitted: the fluid held its most particles.

    bool operator==(const FluidTally&) const = default;
};

/// All particles of a fluid. Arrays are equally long; ids grow from front to back and are never
/// used twice, so two states of one fluid can be compared by walking both at once.
struct FluidState {
    std::vector<glm::vec3> positions;    ///< Centres, metres.
    std::vector<glm::vec3> velocities;   ///< Metres a second.
    std::vector<std::uint64_t> ids;      ///< Increasing.
    std::vector<FluidContact> contacts;  ///< With the mesh after the last step.
    double radius = 0.05;                ///< Of a particle, metres.
    double contact_distance = 0.0625;    ///< Within it a particle counts as colliding, metres.
    double seconds = 0.0;                ///< Simulated so far.
    std::uint64_t next_id = 0;           ///< Of the next particle.
    FluidTally tally;

    std::size_t size() const { return positions.size(); }
    bool operator==(const FluidState&) const = default;
};

/// A particle fluid behind which solvers are exchanged (`mesh-erosion.md` 1.3).
class ParticleFluid {
public:
    virtual ~ParticleFluid() = default;

    /// Take the mesh as what particles collide with; call again whenever it has moved. It is
    /// copied. Counter-clockwise faces look into the fluid.
    /// @throw InvalidInput  check_mesh() refuses it, or it has no triangle.
    virtual void set_mesh(const meshing::TriMesh& mesh) = 0;

    /// Advance by one frame of `seconds`; returns the number of steps it was divided into.
    /// @throw InvalidInput  the frame is no positive number, or too long for this fluid.
    virtual int step(double seconds) = 0;

    virtual const FluidState& state() const = 0;

    /// Go on from another state of the same kind of fluid, or from this one edited.
    /// @throw InvalidInput  check_fluid_state() refuses it.
    virtual void restore(const FluidState& state) = 0;
};

/// Throw InvalidInput unless arrays are equally long, numbers finite, ids increasing and below
/// `next_id`, and the radius and contact distance positive.
void check_fluid_state(const FluidState& state);

/// Put particles at `positions`, all with one velocity.
/// @throw InvalidInput  a number is not finite.
void add_particles(ParticleFluid& fluid, std::span<const glm::vec3> positions,
                   const glm::vec3& velocity = glm::vec3(0.0F));

/// Take the particles of these ids out; ids that do not exist are passed over.
void remove_particles(ParticleFluid& fluid, std::span<const std::uint64_t> ids);

/// Drop the particles whose flag is set; the others keep their order.
/// @pre  One flag a particle.
void drop_particles(FluidState& state, std::span<const std::uint8_t> drop);

/// Places of the particles that touch the mesh, in order.
std::vector<glm::vec3> colliding_positions(const FluidState& state);

}  // namespace scree::terrain
