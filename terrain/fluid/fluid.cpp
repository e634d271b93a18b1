#include "terrain/fluid/fluid.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {
namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void check_fluid_state(const FluidState& state) {
    const std::size_t n = state.size();
    if (state.velocities.size() != n || state.ids.size() != n || state.contacts.size() != n)
        fail<InvalidInput>("a fluid has ", n, " positions, ", state.velocities.size(),
                           " velocities, ", state.ids.size(), " ids and ", state.contacts.size(),
                           " contacts; they must be equally many");
    if (!(state.radius > 0.0) || !std::isfinite(state.radius) || !(state.contact_distance > 0.0) ||
        !std::isfinite(state.contact_distance))
        fail<InvalidInput>("a fluid has particles of radius ", state.radius,
                           " m and contact distance ", state.contact_distance,
                           " m; both must be positive");
    if (!(state.seconds >= 0.0) || !std::isfinite(state.seconds))
        fail<InvalidInput>("a fluid's time is ", state.seconds, " s; it must not be negative");
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_finite(state.positions[i]) || !is_finite(state.velocities[i]))
            fail<InvalidInput>("particle ", i, " of a fluid has a number that is not finite");
        if ((i > 0 && state.ids[i] <= state.ids[i - 1]) || state.ids[i] >= state.next_id)
            fail<InvalidInput>("particle ", i, " of a fluid has id ", state.ids[i],
                               "; ids must increase and stay below ", state.next_id);
    }
}

void add_particles(ParticleFluid& fluid, std::span<const glm::vec3> positions,
                   const glm::vec3& velocity) {
    FluidState state = fluid.state();
    for (const glm::vec3& position : positions) {
        state.positions.push_back(position);
        state.velocities.push_back(velocity);
        state.ids.push_back(state.next_id++);
        state.contacts.emplace_back();
    }
    state.tally.added += positions.size();
    fluid.restore(state);
}

void remove_particles(ParticleFluid& fluid, std::span<const std::uint64_t> ids) {
    FluidState state = fluid.state();
    std::vector<std::uint8_t> drop(state.size(), 0);
    for (const std::uint64_t id : ids) {
        const auto at = std::lower_bound(state.ids.begin(), state.ids.end(), id);
        if (at != state.ids.end() && *at == id)
            drop[static_cast<std::size_t>(at - state.ids.begin())] = 1;
    }
    state.tally.removed +=
        static_cast<std::uint64_t>(std::count(drop.begin(), drop.end(), std::uint8_t{1}));
    drop_particles(state, drop);
    fluid.restore(state);
}

void drop_particles(FluidState& state, std::span<const std::uint8_t> drop) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (drop[i] != 0)
            continue;
        state.positions[kept] = state.positions[i];
        state.velocities[kept] = state.velocities[i];
        state.ids[kept] = state.ids[i];
        state.contacts[kept] = state.contacts[i];
        ++kept;
    }
    state.positions.resize(kept);
    state.velocities.resize(kept);
    state.ids.resize(kept);
    state.contacts.resize(kept);
}

std::vector<glm::vec3> colliding_positions(const FluidState& state) {
    std::vector<glm::vec3> places;
    for (std::size_t i = 0; i < state.size(); ++i)
        if (state.contacts[i].touching())
            places.push_back(state.positions[i]);
    return places;
}

}  // namespace scree::terrain
