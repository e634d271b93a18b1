#include "terrain/fluid/density_solver.h"

#include "base/parallel.h"
#include "terrain/fluid/point_cells.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::terrain::fluid {
namespace {

constexpr std::size_t kBlock = 256;
constexpr float kReach = 2.0F;        // of the mesh, in radii
constexpr float kSafe = 0.999F;       // share of a free way that is gone
constexpr float kLongestMove = 0.5F;  // of one iteration, in radii

template <class Body>
void for_each_particle(std::size_t n, Body&& body) {
    parallel_for_each_index(0, n, kBlock, body);
}

glm::vec3 stopped(const TriangleGrid* mesh, const glm::vec3& from, const glm::vec3& to) {
    if (mesh == nullptr)
        return to;
    const float share = mesh->free_share(from, to);
    return share < 1.0F ? from + (to - from) * (kSafe * share) : to;
}

// Where inertia and gravity carry the particles, as far as the mesh lets them.
void predict(const FluidState& state, const StepSetup& setup, StepArrays& a, float dt) {
    const std::size_t n = state.size();
    a.moves.resize(n);
    for_each_particle(n, [&](std::size_t i) {
        const glm::vec3 velocity = state.velocities[i] + setup.gravity * dt;
        a.moves[i] = stopped(setup.mesh, state.positions[i], state.positions[i] + velocity * dt);
    });
}

// Sort by cells of the predicted places and list each particle's neighbours within h.
void find_neighbours(const FluidState& state, const StepSetup& setup, StepArrays& a) {
    const std::size_t n = state.size();
    const PointCells cells(a.moves, setup.kernel.h);
    a.order.resize(n);
    a.places.resize(n);
    a.old_places.resize(n);
    for_each_particle(n, [&](std::size_t k) {
        a.order[k] = cells.index_of(k);
        a.places[k] = cells.sorted(k);
        a.old_places[k] = state.positions[a.order[k]];
    });
    const float h2 = setup.kernel.h * setup.kernel.h;
    a.neighbours.resize((n + kBlock - 1) / kBlock);
    parallel_for(0, n, kBlock, [&](std::size_t first, std::size_t last) {
        StepArrays::Block& block = a.neighbours[first / kBlock];
        block.starts.clear();
        block.items.clear();
        for (std::size_t k = first; k < last; ++k) {
            block.starts.push_back(static_cast<std::uint32_t>(block.items.size()));
            const glm::vec3 at = a.places[k];
            cells.runs_near(at, setup.kernel.h, [&](std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t j = begin; j < end; ++j) {
                    const glm::vec3 d = cells.sorted(j) - at;
                    if (glm::dot(d, d) < h2 && j != k)
                        block.items.push_back(j);
                }
            });
        }
        block.starts.push_back(static_cast<std::uint32_t>(block.items.size()));
    });
}

template <class Visit>
void for_each_neighbour(const StepArrays& a, std::size_t k, Visit&& visit) {
    const StepArrays::Block& block = a.neighbours[k / kBlock];
    const std::size_t local = k % kBlock;
    for (std::uint32_t i = block.starts[local]; i < block.starts[local + 1]; ++i)
        visit(block.items[i]);
}

// Planes of the mesh around each particle. A particle that began too near is moved out, but not
// made faster by that: its push is left out of the velocity.
void find_planes(const StepSetup& setup, StepArrays& a) {
    const std::size_t n = a.places.size();
    a.planes.assign(n, {});
    a.pushes.assign(n, glm::vec3(0.0F));
    if (setup.mesh == nullptr)
        return;
    for_each_particle(n, [&](std::size_t k) {
        a.planes[k] = setup.mesh->contacts(a.places[k], kReach * setup.radius);
        for (int p = 0; p < a.planes[k].count; ++p) {
            const ContactPlane& plane = a.planes[k].planes[p];
            const float height =
                glm::dot(a.old_places[k] + a.pushes[k] - plane.point, plane.normal);
            if (height < setup.radius)
                a.pushes[k] += plane.normal * (setup.radius - height);
        }
    });
}

// Step size of the density constraint C = sum W / rest + walls - 1 <= 0. Walls count as far as
// their planes are looked for, less what they are there, so that nothing jumps.
void find_lambdas(const StepSetup& setup, StepArrays& a) {
    const SmoothingKernel& kernel = setup.kernel;
    const float scale = 1.0F / setup.rest_sum;
    const float far_wall = kernel.wall(kReach * setup.radius);
    a.lambdas.resize(a.places.size());
    for_each_particle(a.places.size(), [&](std::size_t k) {
        const glm::vec3 at = a.places[k];
        float sum = kernel.density(0.0F);
        float squares = 0.0F;
        glm::vec3 own(0.0F);
        for_each_neighbour(a, k, [&](std::uint32_t j) {
            const glm::vec3 d = at - a.places[j];
            const float squared = glm::dot(d, d);
            const float distance = std::sqrt(squared);
            if (distance >= kernel.h || distance <= 0.0F)
                return;
            sum += kernel.density(squared);
            const glm::vec3 gradient = d * (kernel.slope(distance) * scale / distance);
            own += gradient;
            squares += glm::dot(gradient, gradient);
        });
        float excess = sum * scale - 1.0F;
        for (int p = 0; p < a.planes[k].count; ++p) {
            const ContactPlane& plane = a.planes[k].planes[p];
            const float height = glm::dot(at - plane.point, plane.normal);
            excess += std::max(0.0F, kernel.wall(height) - far_wall);
            own += plane.normal * kernel.wall_slope(height);
        }
        squares += glm::dot(own, own);
        a.lambdas[k] = excess > 0.0F ? -excess / (squares + setup.softness) : 0.0F;
    });
}

// Hold the radius from each plane, with Coulomb friction on what moves along it.
glm::vec3 held_off(const StepSetup& setup, const ContactPlanes& planes, const glm::vec3& from,
                   glm::vec3 to) {
    for (int p = 0; p < planes.count; ++p) {
        const ContactPlane& plane = planes.planes[p];
        const float height = glm::dot(to - plane.point, plane.normal);
        const float missing = setup.radius - height;
        if (missing <= 0.0F)
            continue;
        to += plane.normal * missing;
        const glm::vec3 way = to - from;
        const glm::vec3 along = way - plane.normal * glm::dot(way, plane.normal);
        const float length = glm::length(along);
        if (length > 0.0F)
            to -= along * std::min(1.0F, setup.friction * missing / length);
    }
    return to;
}

void move_apart(const StepSetup& setup, StepArrays& a) {
    const SmoothingKernel& kernel = setup.kernel;
    const float scale = 1.0F / setup.rest_sum;
    const float longest = kLongestMove * setup.radius;
    for_each_particle(a.places.size(), [&](std::size_t k) {
        const glm::vec3 at = a.places[k];
        const float lambda = a.lambdas[k];
        glm::vec3 move(0.0F);
        for_each_neighbour(a, k, [&](std::uint32_t j) {
            const float both = lambda + a.lambdas[j];
            if (both == 0.0F)
                return;
            const glm::vec3 d = at - a.places[j];
            const float distance = glm::length(d);
            if (distance >= kernel.h || distance <= 0.0F)
                return;
            move += d * (both * kernel.slope(distance) * scale / distance);
        });
        for (int p = 0; p < a.planes[k].count; ++p) {
            const ContactPlane& plane = a.planes[k].planes[p];
            const float height = glm::dot(at - plane.point, plane.normal);
            move += plane.normal * (lambda * kernel.wall_slope(height));
        }
        const float length = glm::length(move);
        if (length > longest)
            move *= longest / length;
        a.moves[k] = held_off(setup, a.planes[k], a.old_places[k], at + move);
    });
    std::swap(a.places, a.moves);
}

// Last guard against the mesh, then velocities from the way that was made.
void finish(const StepSetup& setup, StepArrays& a, float dt) {
    const float fastest = 2.0F * setup.radius / dt;
    a.velocities.resize(a.places.size());
    for_each_particle(a.places.size(), [&](std::size_t k) {
        a.places[k] = stopped(setup.mesh, a.old_places[k], a.places[k]);
        glm::vec3 way = a.places[k] - a.old_places[k];
        const float pushed = glm::length(a.pushes[k]);
        if (pushed > 0.0F) {  // no more than it has moved that way
            const glm::vec3 out = a.pushes[k] / pushed;
            way -= out * std::clamp(glm::dot(way, out), 0.0F, pushed);
        }
        glm::vec3 velocity = way / dt;
        const float speed = glm::length(velocity);
        a.velocities[k] = speed > fastest ? velocity * (fastest / speed) : velocity;
    });
}

glm::vec3 smoothed_velocity(const StepSetup& setup, const StepArrays& a, std::size_t k) {
    glm::vec3 change(0.0F);
    for_each_neighbour(a, k, [&](std::uint32_t j) {
        const glm::vec3 d = a.places[k] - a.places[j];
        const float squared = glm::dot(d, d);
        if (squared < setup.kernel.h * setup.kernel.h)
            change += (a.velocities[j] - a.velocities[k]) * setup.kernel.density(squared);
    });
    return a.velocities[k] + change * (setup.viscosity / setup.rest_sum);
}

FluidContact contact_of(const StepSetup& setup, const StepArrays& a, std::size_t k) {
    FluidContact contact;
    for (int p = 0; p < a.planes[k].count; ++p) {
        const ContactPlane& plane = a.planes[k].planes[p];
        const float distance = glm::dot(a.places[k] - plane.point, plane.normal);
        if (distance <= setup.contact_distance &&
            (!contact.touching() || distance < contact.distance))
            contact = {plane.triangle, distance};
    }
    return contact;
}

}  // namespace

void calibrate(StepSetup& setup, float spacing) {
    const int n = static_cast<int>(std::ceil(setup.kernel.h / spacing));
    double sum = 0.0;
    double squares = 0.0;
    for (int z = -n; z <= n; ++z)
        for (int y = -n; y <= n; ++y)
            for (int x = -n; x <= n; ++x) {
                const glm::vec3 d = glm::vec3(x, y, z) * spacing;
                const float squared = glm::dot(d, d);
                if (squared >= setup.kernel.h * setup.kernel.h)
                    continue;
                sum += static_cast<double>(setup.kernel.density(squared));
                if (squared > 0.0F)
                    squares +=
                        std::pow(static_cast<double>(setup.kernel.slope(std::sqrt(squared))), 2.0);
            }
    setup.rest_sum = static_cast<float>(sum);
    setup.softness = static_cast<float>(0.02 * squares / (sum * sum));
}

void advance(FluidState& state, const StepSetup& setup, StepArrays& a, float seconds) {
    predict(state, setup, a, seconds);
    find_neighbours(state, setup, a);
    find_planes(setup, a);
    for (int i = 0; i < setup.iterations; ++i) {
        find_lambdas(setup, a);
        move_apart(setup, a);
    }
    finish(setup, a, seconds);
    for_each_particle(state.size(), [&](std::size_t k) {
        const std::uint32_t i = a.order[k];
        state.positions[i] = a.places[k];
        state.velocities[i] = smoothed_velocity(setup, a, k);
        state.contacts[i] = contact_of(setup, a, k);
    });
}

}  // namespace scree::terrain::fluid
