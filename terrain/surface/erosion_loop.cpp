#include "terrain/surface/erosion_loop.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "meshing/mesh/small_faces.h"
#include "meshing/space/self_intersection.h"
#include "terrain/surface/cosmetic_noise.h"
#include "terrain/surface/weathering_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scree::terrain {
namespace {

using meshing::Adjacency;

constexpr double kSmallFace = 0.1;  // shortest edge, in mean edges (`mesh-erosion.md` 5)
constexpr std::uint64_t kNoiseSeed = 1;
constexpr double kDoseSlack = 1e-9;  // of a step: sums of 1/x are rounded

void check_options(const ErosionLoopOptions& loop) {
    check(loop);
    if (loop.small_faces && loop.scheme == ErosionScheme::Sediment)
        fail<InvalidOption>(
            "small-faces is on under the scheme sediment, which is kept by vertex; take the scheme "
            "wear or leave small faces");
}

class Loop {
public:
    Loop(ErosionRun& run, ParticleFluid& fluid, const ErosionLoopOptions& loop,
         const ErosionHooks& hooks)
        : run_(run), fluid_(fluid), loop_(loop), hooks_(hooks) {}

    void run(WetErosionOptions wet, SedimentOptions sediment) {
        begin(wet, sediment);
        const double first =
            loop_.scheme == ErosionScheme::Wear ? wet.step_limit : sediment.step_limit;
        const double target = loop_.steps / first;
        while (loop_.keep_dose ? run_.dose < target - kDoseSlack / first
                               : run_.report.steps < loop_.steps) {
            report_progress(hooks_.progress, "eroding",
                            std::min(1.0, target > 0.0 ? run_.dose / target : 1.0));
            wet.step_limit = sediment.step_limit = run_.step_limit;
            step(wet, sediment);
            run_.sound = !looks();
            const bool last = run_.dose >= target - kDoseSlack / first;
            if (due(last) && !look(last))
                break;
            if (hooks_.after_step)
                hooks_.after_step(run_);
        }
        report_progress(hooks_.progress, "eroding", 1.0);
        end();
    }

private:
    void begin(const WetErosionOptions& wet, const SedimentOptions& sediment) {
        check(wet);
        check(sediment);
        meshing::check_mesh(run_.mesh);
        adjacency_ = meshing::build_adjacency(run_.mesh);
        check_reach(wet);
        if (run_.fluid.size() > 0 || run_.fluid.seconds > 0.0)
            fluid_.restore(run_.fluid);
        if (run_.step_limit == 0.0) {
            run_.step_limit =
                loop_.scheme == ErosionScheme::Wear ? wet.step_limit : sediment.step_limit;
            if (loop_.cosmetic_noise > 0.0)
                roughen(run_.mesh, adjacency_, loop_.cosmetic_noise, kNoiseSeed);
            run_.report.volume_before = meshing::signed_volume(run_.mesh);
            if (looks())
                run_.report.intersections_before = crossings();
        }
        run_.report.finished = true;
        fluid_.set_mesh(run_.mesh);
        for (; run_.warmed_up < loop_.warm_up; ++run_.warmed_up) {
            report_progress(hooks_.progress, "letting the water in",
                            static_cast<double>(run_.warmed_up) / loop_.warm_up);
            fluid_.step(loop_.frame_seconds);
        }
        run_.fluid = fluid_.state();
        if (looks())
            clean_ = run_;
    }

    // Particles rest a radius away from the surface: with less reach nothing would ever be wet.
    void check_reach(const WetErosionOptions& wet) const {
        const double edge = meshing::mean_edge_length(run_.mesh, adjacency_);
        const double radius = fluid_.state().radius;
        if (loop_.scheme == ErosionScheme::Wear && !(wet.influence * edge > radius))
            fail<InvalidInput>("particles of radius ", radius, " m reach only ",
                               wet.influence * edge, " m, ", wet.influence,
                               " mean edges of the mesh; take an influence of ",
                               std::ceil(2.0 * radius / edge), " or smaller particles");
    }

    bool looks() const { return loop_.check_every > 0; }

    std::size_t crossings() {
        if (hooks_.count_crossings)
            return hooks_.count_crossings(run_.mesh);
        return finder_.find(run_.mesh, adjacency_).pairs.size();
    }

    bool due(bool last) const {
        return looks() && (last || run_.report.steps % loop_.check_every == 0);
    }

    void step(const WetErosionOptions& wet, const SedimentOptions& sediment) {
        ErosionTimes& times = run_.report.times;
        Stopwatch whole;
        Stopwatch watch;
        fluid_.step(loop_.frame_seconds);
        times.fluid += watch.lap();
        if (loop_.scheme == ErosionScheme::Wear)
            wear(wet);
        else
            settle(sediment);
        watch.lap();
        keep_up(wet.rim);
        times.upkeep += watch.lap();
        fluid_.set_mesh(run_.mesh);
        run_.fluid = fluid_.state();
        times.fluid += watch.lap();
        times.iteration += whole.lap();
        count();
    }

    void wear(const WetErosionOptions& wet) {
        const WetErosionReport did =
            erode_wet(run_.mesh, adjacency_, colliding_positions(fluid_.state()), wet, scratch_);
        ErosionTimes& times = run_.report.times;
        times.affected += did.affected_seconds;
        times.curvature += did.curvature_seconds;
        times.laplacian += did.laplacian_seconds;
        times.displacement += did.displacement_seconds;
        run_.report.last = {.mean_edge = did.mean_edge,
                            .least_curvature = did.least_curvature,
                            .greatest_curvature = did.greatest_curvature,
                            .farthest = did.greatest_move,
                            .n_affected = did.n_affected};
    }

    void settle(const SedimentOptions& sediment) {
        Stopwatch watch;
        const SedimentReport did = exchange_sediment(run_.mesh, adjacency_, fluid_.state(),
                                                     loop_.frame_seconds, sediment, run_.sediment);
        run_.report.times.displacement += watch.lap();
        run_.report.last = {.n_affected = did.n_moved};
    }

    void keep_up(meshing::RimPolicy rim) {
        if (loop_.weathering > 0.0)
            weathering_step(run_.mesh, adjacency_,
                            {.step_limit = run_.step_limit / loop_.weathering, .rim = rim},
                            weathering_scratch_);
        if (!loop_.small_faces)
            return;
        const double shortest = kSmallFace * meshing::mean_edge_length(run_.mesh, adjacency_);
        const auto did = meshing::remove_small_faces(run_.mesh, adjacency_, shortest);
        run_.report.n_collapsed += did.n_collapsed;
        if (did.changed)
            finder_ = {};
    }

    // Means over the steps so far.
    void count() {
        ErosionReport& report = run_.report;
        ++report.steps;
        run_.dose += 1.0 / run_.step_limit;
        const double share = 1.0 / report.steps;
        const auto fold = [&](double& mean, std::size_t value) {
            mean += (static_cast<double>(value) - mean) * share;
        };
        std::size_t touching = 0;
        for (const FluidContact& contact : fluid_.state().contacts)
            touching += contact.touching() ? 1 : 0;
        report.last.n_particles = fluid_.state().size();
        report.last.n_touching = touching;
        fold(report.mean_particles, report.last.n_particles);
        fold(report.mean_touching, report.last.n_touching);
        fold(report.mean_affected, report.last.n_affected);
    }

    // Keeps a sound state, or goes back to the last one; false ends the run there.
    bool look(bool last) {
        Stopwatch watch;
        const std::size_t n_crossings = crossings();
        run_.report.times.upkeep += watch.lap();
        if (n_crossings <= run_.report.intersections_before) {
            run_.report.intersections = n_crossings;
            run_.sound = true;
            if (!last)
                clean_ = run_;
            return true;
        }
        const int restarts = run_.report.restarts + 1;
        const ErosionTimes times = run_.report.times;
        const double shorter = run_.step_limit * loop_.shorten;
        run_ = *clean_;
        run_.report.times = times;
        fluid_.restore(run_.fluid);
        fluid_.set_mesh(run_.mesh);
        adjacency_ = meshing::build_adjacency(run_.mesh);
        finder_ = {};
        run_.report.finished = restarts <= loop_.max_restarts;
        if (!run_.report.finished)
            return false;
        run_.report.restarts = restarts;
        run_.step_limit = shorter;
        clean_->step_limit = shorter;
        clean_->report.restarts = restarts;
        return true;
    }

    void end() {
        ErosionReport& report = run_.report;
        report.step_limit = run_.step_limit;
        report.volume = meshing::signed_volume(run_.mesh);
        if (!looks())
            report.intersections = crossings();
    }

    ErosionRun& run_;
    ParticleFluid& fluid_;
    const ErosionLoopOptions& loop_;
    const ErosionHooks& hooks_;
    Adjacency adjacency_;
    meshing::SelfIntersectionFinder finder_;
    WetErosionScratch scratch_;
    StepScratch weathering_scratch_;
    std::optional<ErosionRun> clean_;
};

}  // namespace

void run_erosion(ErosionRun& run, ParticleFluid& fluid, const ErosionLoopOptions& loop,
                 const WetErosionOptions& wet, const SedimentOptions& sediment,
                 const ErosionHooks& hooks) {
    check_options(loop);
    Loop(run, fluid, loop, hooks).run(wet, sediment);
}

}  // namespace scree::terrain
