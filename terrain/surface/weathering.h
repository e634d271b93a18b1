#pragma once

#include "base/progress.h"
#include "meshing/space/self_intersection.h"
#include "terrain/surface/weathering_step.h"

#include <cstdint>
#include <memory>

namespace scree::terrain {

/// Where a run goes on after steps that tangled the mesh (`mesh-erosion.md` 6).
enum class RestartFrom {
    LastClean,  ///< The last state that was found clean.
    Start,      ///< The mesh as it was given: as printed.
};

/// What shorter steps leave as it was.
enum class RestartKeeps {
    Dose,   ///< The sum of 1 / x: as much wear, in more steps.
    Steps,  ///< The number of steps: less wear.
};

inline constexpr std::string_view kRestartFromNames[] = {"last-clean", "start"};
inline constexpr std::string_view kRestartKeepsNames[] = {"dose", "steps"};

constexpr std::span<const std::string_view> names_of(RestartFrom) {
    return kRestartFromNames;
}
constexpr std::span<const std::string_view> names_of(RestartKeeps) {
    return kRestartKeepsNames;
}

struct WeatheringOptions {
    int steps = 50;            ///< At the step limit; shorter steps are as many more.
    double power = 1.0;        ///< n: higher wears protrusions alone.
    double step_limit = 10.0;  ///< x: a vertex moves at most the mean edge over x in a step.
    Reading reading = Reading::Sound;
    WearDirection direction = WearDirection::Umbrella;
    meshing::CurvatureMethod curvature = meshing::CurvatureMethod::Tensor;
    meshing::CurvatureScale scale = meshing::CurvatureScale::DownscaleOnly;
    double quantile = 0.99;     ///< Of the scale `percentile`.
    bool freeze_scale = false;  ///< Keep the first step's factor.
    meshing::RimPolicy rim = meshing::RimPolicy::Pinned;
    double small_faces = 0.1;  ///< Edges below this share of the mean are collapsed; 0 keeps all.
    int check_every = 10;      ///< Steps between looks for self-intersections; 0 never looks.
    RestartFrom restart_from = RestartFrom::LastClean;
    RestartKeeps restart_keeps = RestartKeeps::Dose;
    double restart_factor = 2.0;  ///< Steps become shorter by it.
    int max_restarts = 6;
};

template <class Visitor>
void describe(WeatheringOptions& o, Visitor&& field) {
    field("steps", o.steps, {.min = 0, .max = 1e6, .help = "steps of weathering"});
    field("power", o.power, {.min = 1, .max = 100, .help = "higher wears protrusions alone"});
    field("step-limit", o.step_limit,
          {.min = 1e-3, .max = 1e6, .help = "a step moves at most the mean edge over this"});
    field("reading", o.reading, {.help = "sound or literal form of the published method"});
    field("direction", o.direction, {.help = "towards the neighbours' mean or the normal"});
    field("curvature", o.curvature, {.help = "how mean curvature is estimated"});
    field("scale", o.scale, {.help = "how curvature becomes a number in [-1, 1]"});
    field("quantile", o.quantile,
          {.min = 0, .max = 1, .help = "share of vertices below the scale's unit, percentile"});
    field("freeze-scale", o.freeze_scale, {.help = "keep the first step's scale of curvature"});
    field("rim", o.rim, {.help = "what the rims of an open mesh do"});
    field("small-faces", o.small_faces,
          {.min = 0, .max = 0.9, .help = "collapse edges below this share of the mean; 0 keeps"});
    field("check-every", o.check_every,
          {.min = 0, .max = 1e6, .help = "steps between tests for tangles; 0 never tests"});
    field("restart-from", o.restart_from, {.help = "where a tangled run goes on"});
    field("restart-keeps", o.restart_keeps, {.help = "what shorter steps leave as it was"});
    field("restart-factor", o.restart_factor,
          {.min = 1.01, .max = 100, .help = "how much shorter steps become"});
    field("max-restarts", o.max_restarts, {.min = 0, .max = 60, .help = "most restarts"});
}

/// What a run did; also while it goes on.
struct WeatheringReport {
    std::int64_t steps = 0;        ///< That led to the mesh, without those taken back.
    std::int64_t steps_taken = 0;  ///< All of them, in this process.
    double dose = 0.0;             ///< Sum of 1 / x.
    double dose_wanted = 0.0;
    double step_limit = 0.0;  ///< In the end.
    int restarts = 0;
    std::size_t n_collapsed = 0;      ///< Edges collapsed on the way.
    std::size_t n_blocked = 0;        ///< Short edges that the last step had to leave.
    std::size_t n_intersections = 0;  ///< Pairs of triangles at the last test.
    std::size_t n_at_start = 0;       ///< Pairs that the mesh came with.
    bool tested = false;              ///< There was a test.
    bool test_complete = true;        ///< The last one looked at all pairs.
    bool gave_up = false;             ///< Too many restarts: the mesh is the last clean state.
    meshing::TrianglePair tangle;     ///< A pair that made it give up.
    bool vanished = false;            ///< Nothing is left but a point.
    bool depends_on_units = false;    ///< No curvature passed 1: see CurvatureScale.
    StepReport last;                  ///< Of the last step.
    double step_seconds = 0.0;        ///< Curvature, umbrella vectors and displacement.
    double small_seconds = 0.0;       ///< Removal of small faces.
    double test_seconds = 0.0;        ///< Tests for self-intersection.
};

/// A state from which a run can go on to the same result.
struct WeatheringState {
    meshing::TriMesh mesh;
    std::int64_t steps = 0;
    double dose = 0.0;
    double dose_wanted = 0.0;
    double step_limit = 0.0;
    double start_edge = 0.0;  ///< Mean edge at the first step, metres.
    std::int64_t restarts = 0;
    std::int64_t n_collapsed = 0;
    std::int64_t n_at_start = 0;
    float frozen_factor = 0.0F;
};

/// Weathers one mesh step by step.
class Weathering {
public:
    /// @throw InvalidOption  a value is outside the range that describe() gives.
    /// @throw InvalidInput   check_mesh() or build_adjacency() refuses the mesh, or it has no
    ///                       triangle.
    Weathering(meshing::TriMesh mesh, const WeatheringOptions& options);
    /// Go on from a state of a run with the same mesh and options.
    Weathering(meshing::TriMesh start, const WeatheringOptions& options, WeatheringState state);
    ~Weathering();
    Weathering(const Weathering&) = delete;
    Weathering& operator=(const Weathering&) = delete;

    /// One step with all that belongs to it; false once the run is over.
    bool advance();

    bool finished() const;
    const meshing::TriMesh& mesh() const;  ///< Without normals.
    const meshing::Adjacency& adjacency() const;
    const WeatheringReport& report() const;

    /// The last state known to be clean; without tests the present one.
    WeatheringState state() const;

private:
    struct Run;
    std::unique_ptr<Run> run_;
};

/// Wear a mesh as wind and frost do: protrusions recede, hollows stay (`mesh-erosion.md` 4 to 6).
///
/// After every step small faces go; every few steps the mesh is tested for self-intersections that
/// it did not have before, and if there are some the run goes back and takes shorter steps, more
/// of them, so that the dose stays. Normals are made anew if the mesh had some.
///
/// @post  The mesh has no more self-intersecting pairs than it came with, unless tests are off.
/// @throw InvalidOption, InvalidInput  as Weathering; Cancelled.
WeatheringReport weather(meshing::TriMesh& mesh, const WeatheringOptions& options = {},
                         Progress* progress = nullptr);

}  // namespace scree::terrain
