#include "terrain/surface/weathering.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "meshing/mesh/normals.h"
#include "meshing/mesh/small_faces.h"

#include <algorithm>
#include <utility>

namespace scree::terrain {
namespace {

using meshing::TriMesh;

// A rest of the dose below this share of it is rounding.
constexpr double kDoseRounding = 1e-9;
constexpr double kVanishedEdge = 1e-6;  // of the first step's

StepRules rules_of(const WeatheringOptions& o) {
    StepRules rules;
    rules.power = o.power;
    rules.reading = o.reading;
    rules.direction = o.direction;
    rules.curvature = o.curvature;
    rules.scale = o.scale;
    rules.quantile = o.quantile;
    rules.rim = o.rim;
    return rules;
}

}  // namespace

struct Weathering::Run {
    WeatheringOptions options;
    WeatheringState now;
    WeatheringState clean;  // empty without tests
    TriMesh start;          // only for runs that go back there
    meshing::Adjacency adjacency;
    meshing::SelfIntersectionFinder finder;
    StepScratch scratch;
    StepRules rules;
    WeatheringReport report;
    bool shares_triangles = false;  // the clean state has those of `now`

    bool tests() const { return options.check_every > 0; }
    bool dose_reached() const { return now.dose >= now.dose_wanted * (1.0 - kDoseRounding); }
    bool finished() const { return report.gave_up || report.vanished || dose_reached(); }

    void begin() {
        rules = rules_of(options);
        adjacency = meshing::build_adjacency(now.mesh);
        note();
    }

    void note() {
        report.steps = now.steps;
        report.dose = now.dose;
        report.dose_wanted = now.dose_wanted;
        report.step_limit = now.step_limit;
        report.restarts = static_cast<int>(now.restarts);
        report.n_collapsed = static_cast<std::size_t>(now.n_collapsed);
        report.n_at_start = static_cast<std::size_t>(now.n_at_start);
    }

    // While the triangles stay the same, the clean state holds positions alone.
    void keep_clean() {
        TriMesh kept;
        kept.positions = std::move(clean.mesh.positions);
        kept.positions = now.mesh.positions;
        TriMesh present = std::exchange(now.mesh, {});
        clean = now;
        now.mesh = std::move(present);
        clean.mesh = std::move(kept);
        shares_triangles = true;
    }

    void stop_sharing() {
        if (shares_triangles) {
            clean.mesh.triangles = now.mesh.triangles;
            clean.mesh.texcoords = now.mesh.texcoords;
        }
        shares_triangles = false;
    }

    WeatheringState clean_state() const {
        WeatheringState state = clean;
        if (shares_triangles) {
            state.mesh.triangles = now.mesh.triangles;
            state.mesh.texcoords = now.mesh.texcoords;
        }
        return state;
    }

    void move() {
        const double size = std::min(1.0 / now.step_limit, now.dose_wanted - now.dose);
        rules.step_limit = 1.0 / size;
        rules.frozen_factor = options.freeze_scale ? now.frozen_factor : 0.0F;
        report.last = weathering_step(now.mesh, adjacency, rules, scratch);
        report.depends_on_units = options.scale == meshing::CurvatureScale::DownscaleOnly &&
                                  report.last.range.greatest() <= 1.0F;
        if (options.freeze_scale)
            now.frozen_factor = report.last.factor;
        // Steps follow the edges, so a body shrinks without end; floats do not.
        if (now.start_edge == 0.0)
            now.start_edge = report.last.mean_edge;
        report.vanished = report.last.mean_edge < kVanishedEdge * now.start_edge;
        now.dose += size;
        ++now.steps;
        ++report.steps_taken;
    }

    void remove_small() {
        const auto removed = meshing::remove_small_faces(
            now.mesh, adjacency, options.small_faces * report.last.mean_edge,
            [this] { stop_sharing(); });
        report.n_blocked = removed.n_blocked;
        if (!removed.changed)
            return;
        now.n_collapsed += static_cast<std::int64_t>(removed.n_collapsed);
        finder.compact(removed.kept_triangles);
        report.vanished = report.vanished || now.mesh.triangles.empty();
    }

    void test() {
        const auto tangles = finder.find(now.mesh, adjacency);
        report.tested = true;
        report.test_complete = tangles.complete;
        const auto allowed = static_cast<std::size_t>(now.n_at_start);
        if (tangles.pairs.size() <= allowed) {
            report.n_intersections = tangles.pairs.size();
            keep_clean();
            return;
        }
        report.tangle = tangles.pairs.front();
        go_back();
    }

    void go_back() {
        const double wanted = now.dose_wanted;
        const double limit = now.step_limit;
        const std::int64_t restarts = now.restarts;
        now = clean_state();
        if (restarts >= options.max_restarts) {
            report.gave_up = true;
        } else {
            if (options.restart_from == RestartFrom::Start) {
                now.mesh = start;
                now.steps = 0;
                now.dose = 0.0;
                now.n_collapsed = 0;
                now.frozen_factor = 0.0F;
            }
            now.restarts = restarts + 1;
            now.step_limit = limit * options.restart_factor;
            now.dose_wanted = options.restart_keeps == RestartKeeps::Dose
                                  ? wanted
                                  : now.dose + (wanted - now.dose) / options.restart_factor;
        }
        adjacency = meshing::build_adjacency(now.mesh);
        finder = {};
        keep_clean();
    }
};

Weathering::Weathering(TriMesh mesh, const WeatheringOptions& options)
    : run_(std::make_unique<Run>()) {
    check(options);
    meshing::check_mesh(mesh);
    if (mesh.triangles.empty())
        fail<InvalidInput>("the mesh has no triangle to weather");
    mesh.normals.clear();
    run_->options = options;
    run_->now.mesh = std::move(mesh);
    run_->now.step_limit = options.step_limit;
    run_->now.dose_wanted = options.steps / options.step_limit;
    run_->begin();
    if (options.restart_from == RestartFrom::Start)
        run_->start = run_->now.mesh;
    if (run_->tests() && options.steps > 0) {
        const auto found = run_->finder.find(run_->now.mesh, run_->adjacency);
        run_->now.n_at_start = static_cast<std::int64_t>(found.pairs.size());
        run_->report.n_intersections = found.pairs.size();
        run_->report.tested = true;
        run_->keep_clean();
    }
    run_->note();
}

Weathering::Weathering(TriMesh start, const WeatheringOptions& options, WeatheringState state)
    : run_(std::make_unique<Run>()) {
    check(options);
    meshing::check_mesh(state.mesh);
    if (state.mesh.triangles.empty())
        fail<InvalidInput>("the saved mesh has no triangle to weather");
    state.mesh.normals.clear();
    start.normals.clear();
    run_->options = options;
    run_->now = std::move(state);
    if (options.restart_from == RestartFrom::Start)
        run_->start = std::move(start);
    run_->begin();
    if (run_->tests())
        run_->keep_clean();
}

Weathering::~Weathering() = default;

bool Weathering::advance() {
    Run& run = *run_;
    if (run.finished())
        return false;
    Stopwatch watch;
    run.move();
    run.report.step_seconds += watch.lap();
    if (run.options.small_faces > 0.0)
        run.remove_small();
    run.report.small_seconds += watch.lap();
    const bool due = run.tests() && !run.report.vanished &&
                     (run.now.steps % run.options.check_every == 0 || run.dose_reached());
    if (due) {
        run.test();
        run.report.test_seconds += watch.lap();
    }
    run.note();
    return !run.finished();
}

bool Weathering::finished() const {
    return run_->finished();
}

const TriMesh& Weathering::mesh() const {
    return run_->now.mesh;
}

const meshing::Adjacency& Weathering::adjacency() const {
    return run_->adjacency;
}

const WeatheringReport& Weathering::report() const {
    return run_->report;
}

WeatheringState Weathering::state() const {
    return run_->tests() && !run_->clean.mesh.positions.empty() ? run_->clean_state() : run_->now;
}

WeatheringReport weather(TriMesh& mesh, const WeatheringOptions& options, Progress* progress) {
    const bool had_normals = !mesh.normals.empty();
    Weathering run(mesh, options);
    while (!run.finished()) {
        report_progress(progress, "weathering", run.report().dose / run.report().dose_wanted);
        run.advance();
    }
    mesh = run.mesh();
    if (had_normals)
        mesh.normals = meshing::vertex_normals(mesh, run.adjacency());
    return run.report();
}

}  // namespace scree::terrain
