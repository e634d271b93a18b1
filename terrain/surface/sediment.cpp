#include "terrain/surface/sediment.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

using meshing::Adjacency;
using meshing::TriMesh;

constexpr double kLeastDistance = 0.1;  // of a particle's radius: bounds the shear rate
constexpr double kFlattest = 1e-3;      // volume of a unit move over the ring's area, at least

glm::dvec3 face_normal(const TriMesh& mesh, const glm::uvec3& f) {
    const glm::dvec3 a(mesh.positions[f.x]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[f.y]) - a, glm::dvec3(mesh.positions[f.z]) - a);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

// theta = |v| / d (`mesh-erosion.md` 8.4).
double shear_rate(const TriMesh& mesh, const FluidState& fluid, std::size_t i,
                  ShearVelocity which) {
    const FluidContact& contact = fluid.contacts[i];
    glm::dvec3 velocity(fluid.velocities[i]);
    if (which == ShearVelocity::Tangential) {
        const glm::dvec3 normal = face_normal(mesh, mesh.triangles[contact.triangle]);
        velocity -= normal * glm::dot(velocity, normal);
    }
    const double distance =
        std::max(std::abs(static_cast<double>(contact.distance)), kLeastDistance * fluid.radius);
    return glm::length(velocity) / distance;
}

// Volume that a particle would take up (positive) or lay down in the step.
double exchanged_volume(double rate, const FluidState& fluid, double carried, double seconds,
                        const SedimentOptions& options) {
    const double area = std::numbers::pi * fluid.radius * fluid.radius;
    const double volume = rate * area * seconds;
    if (volume < 0.0)
        return -std::min(-volume, carried);
    if (options.capacity <= 0.0)
        return volume;
    const double most = options.capacity * 4.0 / 3.0 * area * fluid.radius;
    return std::clamp(most - carried, 0.0, volume);
}

void exchange(const TriMesh& mesh, const Adjacency& adjacency, const FluidState& fluid,
              double seconds, const SedimentOptions& options, SedimentState& state,
              SedimentReport& report) {
    std::vector<double> rates(fluid.size(), 0.0);
    parallel_for_each_index(0, fluid.size(), 512, [&](std::size_t i) {
        if (fluid.contacts[i].touching())
            rates[i] = erosion_rate(shear_rate(mesh, fluid, i, options.shear), options);
    });
    for (std::size_t i = 0; i < fluid.size(); ++i) {
        if (!fluid.contacts[i].touching())
            continue;
        const glm::uvec3& face = mesh.triangles[fluid.contacts[i].triangle];
        int n_free = 0;
        for (int c = 0; c < 3; ++c)
            n_free += adjacency.rim[face[c]] == 0 ? 1 : 0;
        if (n_free == 0)
            continue;
        const double volume = exchanged_volume(rates[i], fluid, state.carried[i], seconds, options);
        state.carried[i] += volume;
        (volume > 0.0 ? report.eroded : report.deposited) += std::abs(volume);
        for (int c = 0; c < 3; ++c)
            if (adjacency.rim[face[c]] == 0)
                state.pending[face[c]] -= volume / n_free;
        ++report.n_exchanges;
    }
}

struct Ring {
    glm::dvec3 areas{0.0};  // sum of b x c: twice the vector area
    double area = 0.0;      // sum of the triangles'
    double edges = 0.0;     // sum of the lengths of b
    std::size_t n = 0;
};

Ring ring_of(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex) {
    Ring ring;
    const glm::dvec3 at(mesh.positions[vertex]);
    for (const std::uint32_t corner : adjacency.corners_of(vertex)) {
        const glm::uvec3 face = meshing::vertices_from(mesh, corner);
        const glm::dvec3 b = glm::dvec3(mesh.positions[face.y]) - at;
        const glm::dvec3 c = glm::dvec3(mesh.positions[face.z]) - at;
        const glm::dvec3 product = glm::cross(b, c);
        ring.areas += product;
        ring.area += 0.5 * glm::length(product);
        ring.edges += glm::length(b);
        ++ring.n;
    }
    return ring;
}

// Moves one vertex by what it owes (`mesh-erosion.md` 8.6, signed form) and returns the volume that
// the mesh gained. The normal is that of the ring's vector area, along which a move of 1 sweeps
// the most: V1 = |sum b x c| / 6.
double settle_vertex(TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex, double owed,
                     double step_limit) {
    const Ring ring = ring_of(mesh, adjacency, vertex);
    const double length = glm::length(ring.areas);
    const double per_metre = length / 6.0;
    if (ring.n == 0 || per_metre < kFlattest * ring.area)
        return 0.0;
    const double longest = ring.edges / static_cast<double>(ring.n) / step_limit;
    const double way = std::clamp(owed / per_metre, -longest, longest);
    const glm::vec3 before = mesh.positions[vertex];
    const glm::vec3 after(glm::dvec3(before) + ring.areas * (way / length));
    mesh.positions[vertex] = after;
    return glm::dot(glm::dvec3(after) - glm::dvec3(before), ring.areas) / 6.0;
}

}  // namespace

double erosion_rate(double rate_of_shear, const SedimentOptions& options) {
    const double stress = options.shear_constant * std::pow(rate_of_shear, options.shear_power);
    const double excess = stress - options.critical;
    return std::copysign(options.rate * std::pow(std::abs(excess), options.exponent), excess);
}

double SedimentState::carried_sum() const {
    return std::accumulate(carried.begin(), carried.end(), 0.0);
}

double SedimentState::pending_sum() const {
    return std::accumulate(pending.begin(), pending.end(), 0.0);
}

void follow_particles(SedimentState& state, const FluidState& fluid) {
    std::vector<double> carried(fluid.size(), 0.0);
    std::size_t old = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i) {
        while (old < state.ids.size() && state.ids[old] < fluid.ids[i])
            state.lost += state.carried[old++];
        if (old < state.ids.size() && state.ids[old] == fluid.ids[i])
            carried[i] = state.carried[old++];
    }
    while (old < state.ids.size())
        state.lost += state.carried[old++];
    state.carried = std::move(carried);
    state.ids = fluid.ids;
}

SedimentReport exchange_sediment(TriMesh& mesh, const Adjacency& adjacency, const FluidState& fluid,
                                 double seconds, const SedimentOptions& options,
                                 SedimentState& state) {
    check(options);
    if (!(seconds > 0.0) || !std::isfinite(seconds))
        fail<InvalidInput>("a step of sediment takes ", seconds, " s; it must be positive");
    for (const FluidContact& contact : fluid.contacts)
        if (contact.touching() && contact.triangle >= mesh.triangles.size())
            fail<InvalidInput>("a particle touches triangle ", contact.triangle,
                               " of a mesh that has ", mesh.triangles.size(),
                               "; give the fluid this mesh first");
    SedimentReport report;
    state.pending.resize(mesh.positions.size(), 0.0);
    follow_particles(state, fluid);
    exchange(mesh, adjacency, fluid, seconds, options, state, report);
    for (std::size_t v = 0; v < state.pending.size(); ++v) {
        if (state.pending[v] == 0.0)
            continue;
        const double gained =
            settle_vertex(mesh, adjacency, v, state.pending[v], options.step_limit);
        state.pending[v] -= gained;
        report.volume_change += gained;
        report.n_moved += gained != 0.0 ? 1 : 0;
    }
    state.eroded += report.eroded;
    state.deposited += report.deposited;
    return report;
}

}  // namespace scree::terrain
