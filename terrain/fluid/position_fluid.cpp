#include "terrain/fluid/position_fluid.h"

#include "base/error.h"
#include "terrain/fluid/density_solver.h"
#include "terrain/fluid/point_cells.h"
#include "terrain/fluid/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

constexpr double kFarthest = 0.8;               // way of a step, in spacings
constexpr double kContact = 1.25;               // contact distance, in radii
constexpr float kTooNear = 0.6F;                // of a spacing: no room for a new particle
constexpr std::size_t kMostAtOnce = 1'000'000;  // new particles, whatever becomes of them
constexpr double kWidestOpening = 500;          // in spacings

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_setup(const PositionFluidSetup& setup) {
    check(setup.options);
    check_emitters(setup.emitters);
    if (!is_finite(setup.gravity))
        fail<InvalidInput>("the gravity of a fluid has a number that is not finite");
    const FluidBox& d = setup.domain;
    if (!is_finite(d.low) || !is_finite(d.high) ||
        !(d.low.x < d.high.x && d.low.y < d.high.y && d.low.z < d.high.z))
        fail<InvalidInput>(
            "the domain of a fluid has no inside; every number of `low` must be below that of "
            "`high`");
    for (std::size_t i = 0; i < setup.emitters.sources.size(); ++i)
        if (setup.emitters.sources[i].radius > kWidestOpening * 2.0 * setup.options.radius)
            fail<InvalidInput>("source ", i, " has radius ", setup.emitters.sources[i].radius,
                               " m, more than ", kWidestOpening, " particles of radius ",
                               setup.options.radius, " m; take larger particles");
}

}  // namespace

struct PositionFluid::Solver {
    explicit Solver(PositionFluidSetup given) : setup(std::move(given)) {
        check_setup(setup);
        const PositionFluidOptions& o = setup.options;
        state.radius = o.radius;
        state.contact_distance = kContact * o.radius;
        step_setup.kernel = SmoothingKernel(4.0 * o.radius);
        step_setup.radius = static_cast<float>(o.radius);
        step_setup.contact_distance = static_cast<float>(state.contact_distance);
        step_setup.viscosity = static_cast<float>(o.viscosity);
        step_setup.friction = static_cast<float>(o.friction);
        step_setup.iterations = o.iterations;
        step_setup.gravity = setup.gravity;
        fluid::calibrate(step_setup, static_cast<float>(spacing()));
    }

    double spacing() const { return 2.0 * setup.options.radius; }

    int substeps(double seconds) const {
        double fastest = 0.0;
        for (const glm::vec3& v : state.velocities)
            fastest = std::max(fastest, static_cast<double>(glm::length(v)));
        const double fall = static_cast<double>(glm::length(setup.gravity));
        const double farthest = kFarthest * spacing();
        const double way = (fastest + fall * seconds) * seconds;
        const double n =
            std::ceil(std::max(way / farthest, seconds * std::sqrt(2.0 * fall / farthest)));
        if (n > setup.options.max_substeps)
            fail<InvalidInput>("a frame of ", seconds, " s with water at up to ", fastest,
                               " m/s needs ", n, " steps, at most ", setup.options.max_substeps,
                               " are allowed; take shorter frames or larger particles");
        return std::max(1, static_cast<int>(n));
    }

    void drop_lost() {
        std::vector<std::uint8_t> drop(state.size(), 0);
        for (std::size_t i = 0; i < state.size(); ++i) {
            const glm::vec3& p = state.positions[i];
            if (!setup.domain.holds(p)) {
                drop[i] = 1;
                ++state.tally.left_domain;
                continue;
            }
            for (const FluidBox& sink : setup.emitters.sinks)
                if (drop[i] == 0 && sink.holds(p)) {
                    drop[i] = 1;
                    ++state.tally.drained;
                }
        }
        if (std::find(drop.begin(), drop.end(), 1) != drop.end())
            drop_particles(state, drop);
    }

    void emit(double from, double to) {
        const auto most = static_cast<std::size_t>(setup.options.max_particles);
        const auto seed = static_cast<std::uint64_t>(setup.options.seed);
        const NewParticles made =
            emitted_between(setup.emitters, from, to, spacing(), seed, kMostAtOnce + 4 * most);
        if (made.positions.empty())
            return;
        const auto room = kTooNear * static_cast<float>(spacing());
        const PointCells cells(state.positions, static_cast<float>(spacing()));
        for (std::size_t i = 0; i < made.positions.size(); ++i) {
            const glm::vec3& p = made.positions[i];
            if (!setup.domain.holds(p) || cells.nearest_squared(p, room) < room * room ||
                (mesh.n_triangles() > 0 && mesh.buried(p))) {
                ++state.tally.blocked;
            } else if (state.size() >= most) {
                ++state.tally.refused;
            } else {
                state.positions.push_back(p);
                state.velocities.push_back(made.velocities[i]);
                state.ids.push_back(state.next_id++);
                state.contacts.emplace_back();
                ++state.tally.emitted;
            }
        }
    }

    PositionFluidSetup setup;
    FluidState state;
    TriangleGrid mesh;
    bool openings_checked = false;
    fluid::StepSetup step_setup;
    fluid::StepArrays arrays;
};

PositionFluid::PositionFluid(PositionFluidSetup setup)
    : solver_(std::make_unique<Solver>(std::move(setup))) {}

PositionFluid::~PositionFluid() = default;

void PositionFluid::set_mesh(const meshing::TriMesh& mesh) {
    Solver& s = *solver_;
    s.mesh = TriangleGrid(mesh, static_cast<float>(s.spacing()));
    s.step_setup.mesh = &s.mesh;
    if (std::exchange(s.openings_checked, true))
        return;
    for (std::size_t i = 0; i < s.setup.emitters.sources.size(); ++i) {
        const auto places = opening_places(s.setup.emitters.sources[i], s.spacing());
        const auto buried = [&](const glm::vec3& p) { return s.mesh.buried(p); };
        if (std::all_of(places.begin(), places.end(), buried))
            fail<InvalidInput>("source ", i,
                               " lies inside the mesh with its whole opening; move "
                               "it into the open");
    }
}

int PositionFluid::step(double seconds) {
    if (!(seconds > 0.0) || !std::isfinite(seconds))
        fail<InvalidInput>("a frame of a fluid takes ", seconds, " s; it must be positive");
    Solver& s = *solver_;
    const int n = s.substeps(seconds);
    for (int i = 0; i < n; ++i) {
        if (s.state.size() > 0)
            fluid::advance(s.state, s.step_setup, s.arrays, static_cast<float>(seconds / n));
        s.drop_lost();
    }
    const double from = s.state.seconds;
    s.state.seconds = from + seconds;
    s.emit(from, s.state.seconds);
    return n;
}

const FluidState& PositionFluid::state() const {
    return solver_->state;
}

void PositionFluid::restore(const FluidState& state) {
    check_fluid_state(state);
    if (state.radius != solver_->state.radius)
        fail<InvalidInput>("a fluid's state has particles of radius ", state.radius,
                           " m, the fluid has ", solver_->state.radius, " m");
    solver_->state = state;
}

}  // namespace scree::terrain
