#include "terrain/scene/simulation.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "terrain/scene/ground_builder.h"
#include "terrain/scene/scene_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scree::terrain {
namespace {

constexpr double kMostTravel = 0.75;  // cells in a substep: a track without gaps or scallops
constexpr int kMostSubsteps = 64;
constexpr double kTouched = 1e-6;  // metres of displacement that count as moved

// The scene is to blame, and its file is what a person mends.
SolverChoice solver_of(const Scene& scene, const Heightfield& base, const SoilField& soil,
                       Device device) {
    try {
        return make_solver(base, soil, scene.deformer, device);
    } catch (const InvalidOption& error) {
        fail<InvalidInput>(scene.source, ": deformer: ", error.what());
    }
}

SoilField soils_of(const Scene& scene, const DescriptionMap& map, double cell_size) {
    try {
        return SoilField(map, cell_size);
    } catch (const InvalidInput& error) {
        fail<InvalidInput>(scene.source, ": ", error.what());
    }
}

std::vector<SceneBody> bodies_of(const Scene& scene, const CellGrid& grid) {
    std::vector<SceneBody> bodies;
    bodies.reserve(scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        try {
            bodies.emplace_back(scene.objects[i], grid);
        } catch (const InvalidOption& error) {
            fail<InvalidInput>(scene.source, ": objects[", i, "].shape: ", error.what());
        } catch (const InvalidInput& error) {
            fail<InvalidInput>(scene.source, ": objects[", i, "].shape: ", error.what());
        }
    }
    return bodies;
}

double steepness(const FloatRaster& heights, int x, int y, int other_x, int other_y) {
    return std::fabs(static_cast<double>(heights(other_x, other_y)) - heights(x, y));
}

}  // namespace

struct Simulation::State {
    State(const Scene& of, Device device)
        : scene(&of),
          base(build_heights(of)),
          map(build_map(of, base)),
          soil(soils_of(of, map, base.cell_size)),
          grid{{0, 0, base.heights.width(), base.heights.height()}, base.cell_size},
          chosen(solver_of(of, base, soil, device)),
          bodies(bodies_of(of, grid)) {
        stiffness.fill(static_cast<float>(1000.0 * kDefaultBearing));
        for (const Material& material : map.materials)
            if (const auto found = of.bearing.find(material.name); found != of.bearing.end())
                stiffness[static_cast<std::size_t>(material.id)] =
                    static_cast<float>(1000.0 * found->second);
        lowest = *std::min_element(base.heights.begin(), base.heights.end());
    }

    int substeps(double from_s, double to_s) const {
        if (scene->substeps > 0)
            return scene->substeps;
        double most = 0.0;
        for (const SceneBody& body : bodies)
            most = std::max(most, body.travel_cells(from_s, to_s));
        return std::clamp(static_cast<int>(std::ceil(most / kMostTravel)), 1, kMostSubsteps);
    }

    FloatRaster stiffness_under(const CellWindow& window) const {
        FloatRaster out(window.width, window.height);
        for (int y = 0; y < window.height; ++y)
            for (int x = 0; x < window.width; ++x)
                out(x, y) =
                    stiffness[static_cast<std::size_t>(soil.id_at(window.x + x, window.y + y))];
        return out;
    }

    void press(FrameReport& report);

    const Scene* scene;
    Heightfield base;
    DescriptionMap map;
    SoilField soil;
    CellGrid grid;
    SolverChoice chosen;
    std::vector<SceneBody> bodies;
    std::array<float, 256> stiffness{};
    float lowest = 0.0F;
    int frame = 0;
    double compacted_m3 = 0.0;
    bool lifted = false;  // the objects, for the ground to settle
};

// Forces of every body on its own window; where windows overlap the solver adds them up.
void Simulation::State::press(FrameReport& report) {
    Stopwatch watch;
    std::vector<Load> loads;
    report.contact_cells = 0;
    report.unspent_n = 0.0;
    for (SceneBody& body : bodies) {
        if (!body.present() || body.underside().window.empty())
            continue;
        const PressingBody pressing = body.pressing();
        const CellWindow window = body.underside().window;
        const FloatRaster heights = chosen.solver->heights(window);
        SoilTile tile;
        if (scene->contact.reading == Reading::Literal)
            soil.fill(window, tile);
        ContactLoad contact = contact_load(
            {&pressing, 1}, {window, &heights, &tile.mobility, grid.cell_size}, scene->contact);
        body.note(contact.bodies[0]);
        report.contact_cells += contact.bodies[0].cells;
        report.unspent_n += contact.bodies[0].unspent_force;
        if (contact.bodies[0].cells > 0)
            loads.push_back(std::move(contact.load));
    }
    report.contact_ms += 1000.0 * watch.lap();
    const DeformerReport done = chosen.solver->step(loads);
    report.step_ms += 1000.0 * watch.lap();
    report.tiles = done.tiles_stepped;
    report.compacted_m3 += done.compacted_m3;
}

Simulation::Simulation(const Scene& scene, Device device)
    : state_(std::make_unique<State>(scene, device)) {}

Simulation::~Simulation() = default;

FrameReport Simulation::step() {
    State& s = *state_;
    const double frame_s = 1.0 / s.scene->frame_rate;
    const double start_s = s.frame * frame_s;
    FrameReport report;
    s.lifted = false;
    report.substeps = s.substeps(start_s, start_s + frame_s);
    const double step_s = frame_s / report.substeps;
    for (int i = 0; i < report.substeps; ++i) {
        Stopwatch watch;
        for (SceneBody& body : s.bodies)
            body.move(
                start_s + (i + 1) * step_s, step_s, *s.chosen.solver,
                [&s](const CellWindow& window) { return s.stiffness_under(window); },
                s.scene->contact.gravity);
        report.place_ms += 1000.0 * watch.lap();
        s.press(report);
    }
    s.compacted_m3 += report.compacted_m3;
    ++s.frame;
    return report;
}

SettleReport Simulation::settle() {
    State& s = *state_;
    if (s.scene->deformer.reading == Reading::Literal || s.scene->deformer.border == Border::Zero)
        fail<InvalidInput>(s.scene->source,
                           ": only the sound reading with border no-flux comes to rest");
    FloatRaster moved = s.chosen.solver->displacement(s.grid.extent);
    const SettleReport report =
        settle_to_rest(moved, s.base, s.soil, {.keep_base = s.scene->deformer.keep_base});
    s.chosen.solver->replace_displacement(moved);
    s.lifted = true;
    return report;
}

int Simulation::frame() const {
    return state_->frame;
}

const Heightfield& Simulation::base() const {
    return state_->base;
}

const DescriptionMap& Simulation::map() const {
    return state_->map;
}

const GroundSolver& Simulation::ground() const {
    return *state_->chosen.solver;
}

const std::string& Simulation::device_reason() const {
    return state_->chosen.reason;
}

CellWindow Simulation::extent() const {
    return state_->grid.extent;
}

std::vector<PlacedObject> Simulation::objects() const {
    std::vector<PlacedObject> out;
    for (const SceneBody& body : state_->bodies)
        out.push_back({&body.object(), &body.mesh(), body.world_from_mesh(),
                       body.present() && !state_->lifted});
    return out;
}

std::vector<ObjectReport> Simulation::object_reports() const {
    std::vector<ObjectReport> out;
    for (const SceneBody& body : state_->bodies)
        out.push_back({body.object().name, body.deepest_m(), body.most_cells(), body.unspent_n(),
                       body.ever_smaller_than_cell()});
    return out;
}

std::vector<MaterialReport> Simulation::material_reports() const {
    const State& s = *state_;
    std::vector<MaterialReport> out;
    std::array<std::size_t, 256> slot{};
    for (const Material& material : s.map.materials) {
        slot[static_cast<std::size_t>(material.id)] = out.size();
        out.push_back({material.name, material.id, material.soil.repose_deg});
    }
    const CellWindow all = s.grid.extent;
    const FloatRaster moved = s.chosen.solver->displacement(all);
    const FloatRaster heights = s.chosen.solver->heights(all);
    const double area = s.grid.cell_size * s.grid.cell_size;
    std::vector<double> steepest(out.size(), 0.0);
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x) {
            const std::size_t here = slot[static_cast<std::size_t>(s.soil.id_at(x, y))];
            const float u = moved(x, y);
            out[here].moved_m3 += 0.5 * area * std::fabs(static_cast<double>(u));
            out[here].deepest_m = std::max(out[here].deepest_m, -static_cast<double>(u));
            out[here].highest_m = std::max(out[here].highest_m, static_cast<double>(u));
            for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
                const int ox = x + dx;
                const int oy = y + dy;
                if (!moved.contains(ox, oy) ||
                    std::max(std::fabs(u), std::fabs(moved(ox, oy))) < static_cast<float>(kTouched))
                    continue;
                // The higher cell's soil is the one that would slide.
                const bool other = heights(ox, oy) > heights(x, y);
                const std::size_t owner =
                    other ? slot[static_cast<std::size_t>(s.soil.id_at(ox, oy))] : here;
                steepest[owner] = std::max(steepest[owner], steepness(heights, x, y, ox, oy));
            }
        }
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i].greatest_slope_deg =
            std::atan(steepest[i] / s.grid.cell_size) * 180.0 / std::numbers::pi;
    return out;
}

VolumeReport Simulation::volume() const {
    const State& s = *state_;
    const double area = s.grid.cell_size * s.grid.cell_size;
    const double floor = static_cast<double>(s.lowest) - 1.0;
    VolumeReport out;
    double before = 0.0;
    double moved = 0.0;
    for (const float height : s.base.heights)
        before += height - floor;
    for (const float u : s.chosen.solver->displacement(s.grid.extent))
        moved += std::fabs(static_cast<double>(u));
    out.before_m3 = area * before;
    out.moved_m3 = 0.5 * area * moved;
    out.compacted_m3 = s.compacted_m3;
    const double change = s.chosen.solver->displaced_volume();
    out.after_m3 = out.before_m3 + change;
    const double drift = change + s.compacted_m3;
    out.relative_drift = drift / out.before_m3;
    out.drift_of_moved = out.moved_m3 > 0.0 ? drift / out.moved_m3 : 0.0;
    return out;
}

}  // namespace scree::terrain
