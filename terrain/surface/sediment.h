#pragma once

#include "base/options.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/tri_mesh.h"
#include "terrain/fluid/fluid.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// Which part of a particle's velocity shears the bed (`mesh-erosion.md` 8.4).
enum class ShearVelocity {
    Tangential,  ///< Along the face.
    Full,        ///< All of it: a jet wears most where it strikes.
};
inline constexpr std::string_view kShearVelocityNames[] = {"tangential", "full"};
constexpr std::span<const std::string_view> names_of(ShearVelocity) {
    return kShearVelocityNames;
}

/// What water takes and drops (`mesh-erosion.md` 8.4).
struct SedimentOptions {
    double rate = 1e-4;           ///< k of the rate law, m3/(N s).
    double critical = 5.0;        ///< Shear stress that moves nothing, Pa.
    double exponent = 1.0;        ///< a of the rate law.
    double shear_constant = 1.0;  ///< K of the shear stress, Pa s^m.
    double shear_power = 0.5;     ///< m of the shear stress.
    ShearVelocity shear = ShearVelocity::Tangential;
    double capacity = 0.0;     ///< Most sediment in a particle over its volume; 0 for any.
    double step_limit = 10.0;  ///< A step moves a vertex by at most its mean edge over this.
};

template <class Visitor>
void describe(SedimentOptions& o, Visitor&& field) {
    field("rate", o.rate, {.min = 0, .max = 1e3, .help = "speed of wear over excess shear stress"});
    field("critical", o.critical,
          {.min = 0, .max = 1e9, .unit = "Pa", .help = "shear stress that moves nothing"});
    field("exponent", o.exponent, {.min = 0.1, .max = 10, .help = "of the excess shear stress"});
    field("shear-constant", o.shear_constant,
          {.min = 0, .max = 1e6, .help = "shear stress at a shear rate of one"});
    field("shear-power", o.shear_power, {.min = 0.1, .max = 3, .help = "of the shear rate"});
    field("shear", o.shear, {.help = "which velocity shears the bed"});
    field("capacity", o.capacity,
          {.min = 0, .max = 1e6, .help = "most sediment over a particle's volume; 0 for any"});
    field("step-limit", o.step_limit,
          {.min = 1, .max = 1e6, .help = "a step moves at most a mean edge over this"});
}

/// Erosion rate (positive) or deposition rate (negative) of a face under a shear rate, m/s
/// (`mesh-erosion.md` 8.4, with the sign kept for any exponent).
double erosion_rate(double shear_rate, const SedimentOptions& options);

/// Where all sediment is, cubic metres.
///
/// The mesh's volume + carried + pending + lost stays the same to rounding: what left the mesh
/// floats in particles, waits at vertices or left the domain.
struct SedimentState {
    std::vector<double> carried;     ///< Of each particle, in the order of its fluid.
    std::vector<std::uint64_t> ids;  ///< Of those particles.
    std::vector<double> pending;     ///< Of each vertex: to be laid on (positive) or taken off.
    double lost = 0.0;               ///< Went with particles that are gone.
    double eroded = 0.0;             ///< Ever taken up.
    double deposited = 0.0;          ///< Ever laid down.

    double carried_sum() const;
    double pending_sum() const;
};

/// What one step did.
struct SedimentReport {
    std::size_t n_exchanges = 0;  ///< Particles that touched a face.
    std::size_t n_moved = 0;      ///< Vertices.
    double eroded = 0.0;          ///< Cubic metres.
    double deposited = 0.0;       ///< Cubic metres.
    double volume_change = 0.0;   ///< Of the mesh, cubic metres.
};

/// Follow the particles from the last state to this one: new ones carry nothing, what the missing
/// ones carried is lost.
void follow_particles(SedimentState& state, const FluidState& fluid);

/// One step of the older scheme (`mesh-erosion.md` 8.4 to 8.6): every touching particle takes up
/// sediment from its face or lays some down, in equal shares to the face's corners; then vertices
/// move along their normals one after another, each by exactly the volume it owes, as far as a step
/// may; the rest stays pending. Vertices on a rim never move and share nothing.
///
/// The ledger counts the volumes that the stored, rounded places really enclose.
/// @param seconds  Time that the contact lasts.
/// @pre   The adjacency is the mesh's own.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   `seconds` is not positive, or a contact names a triangle that the mesh
///                       does not have.
SedimentReport exchange_sediment(meshing::TriMesh& mesh, const meshing::Adjacency& adjacency,
                                 const FluidState& fluid, double seconds,
                                 const SedimentOptions& options, SedimentState& state);

}  // namespace scree::terrain
