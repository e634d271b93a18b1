#include "apps/weather_job.h"

#include "apps/step_log.h"
#include "apps/weather_pictures.h"
#include "base/number_text.h"
#include "base/whole_file.h"
#include "meshing/curvature/curvature_colours.h"
#include "meshing/io/mesh_io.h"
#include "meshing/mesh/normals.h"
#include "terrain/surface/weathering_file.h"
#include "vision/image_io.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;
using meshing::TriMesh;
using terrain::Weathering;

constexpr std::size_t kMostCheckpointBytes = std::size_t{8} << 30;

// A row a step (`mesh-erosion.md` 12).
class Rows {
public:
    explicit Rows(const WeatherJob& job) : job_(job), log_(job.csv, header(job.csv_times)) {}

    void resume(const Weathering& run) {
        if (wanted())
            log_.resume(run.report().steps);
    }

    void add(const Weathering& run) {
        const terrain::WeatheringReport& r = run.report();
        if (!wanted())
            return;
        CsvRow row;
        row.put(r.step_limit).put(r.restarts).put(r.last.mean_edge);
        row.put(r.last.range.low).put(r.last.range.high).put(r.last.n_moved);
        row.put(r.last.farthest).put(meshing::signed_volume(run.mesh()));
        row.put(meshing::surface_area(run.mesh())).put(run.mesh().positions.size());
        row.put(run.mesh().triangles.size()).put(r.n_intersections);
        const double times[] = {r.step_seconds, r.small_seconds, r.test_seconds};
        for (std::size_t k = 0; k < std::size(times); ++k) {
            if (job_.csv_times)
                row.put(1e3 * (times[k] - before_[k]));
            before_[k] = times[k];
        }
        log_.add(r.steps, row.text());
    }

    bool wanted() const { return !job_.csv.empty(); }
    std::string text() const { return log_.text(); }

private:
    static std::string header(bool times) {
        return std::string(
                   "step,step_limit,restarts,mean_edge_m,curvature_low,curvature_high,moved,"
                   "farthest_m,volume_m3,area_m2,vertices,triangles,self_intersections") +
               (times ? ",step_ms,small_faces_ms,test_ms" : "");
    }

    const WeatherJob& job_;
    StepLog log_;
    double before_[3] = {};
};

// Saves the run from time to time, and once more when it is stopped.
class Checkpoint {
public:
    Checkpoint(const WeatherJob& job, const TriMesh& start)
        : job_(job), key_(job.checkpoint.empty() ? 0 : terrain::run_key(start, job.options)) {}

    bool exists() const { return !job_.checkpoint.empty() && fs::exists(job_.checkpoint); }

    terrain::WeatheringState read() const {
        const std::string bytes = read_whole_file(job_.checkpoint, kMostCheckpointBytes);
        return terrain::decode_state(
            {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, key_,
            job_.checkpoint.string());
    }

    void save(const Weathering& run, const Rows& rows) {
        if (job_.checkpoint.empty())
            return;
        if (rows.wanted())
            write_whole_file(job_.csv, rows.text());
        write_whole_file(job_.checkpoint,
                         std::string_view(terrain::encode_state(run.state(), key_)));
        last_ = Clock::now();
    }

    void save_if_due(const Weathering& run, const Rows& rows) {
        if (std::chrono::duration<double>(Clock::now() - last_).count() >= job_.save_seconds)
            save(run, rows);
    }

    void remove() const {
        std::error_code ignored;
        if (!job_.checkpoint.empty())
            fs::remove(job_.checkpoint, ignored);
    }

private:
    using Clock = std::chrono::steady_clock;
    const WeatherJob& job_;
    std::uint64_t key_;
    Clock::time_point last_ = Clock::now();
};

void run_to_the_end(Weathering& run, Checkpoint& checkpoint, Rows& rows, Progress* progress) {
    try {
        while (!run.finished()) {
            report_progress(progress, "weathering", run.report().dose / run.report().dose_wanted);
            run.advance();
            rows.add(run);
            checkpoint.save_if_due(run, rows);
        }
    } catch (const Cancelled&) {
        checkpoint.save(run, rows);
        throw;
    }
}

// The mesh with normals, and with curvature scaled as the weathering scales it if asked for.
WornMesh worn(const WeatherJob& job, const TriMesh& mesh, const meshing::Adjacency& adjacency) {
    WornMesh result{mesh, {}};
    result.mesh.normals = meshing::vertex_normals(mesh, adjacency);
    if (!job.curvature_colours)
        return result;
    result.scaled_curvature =
        meshing::mean_curvature(mesh, adjacency, result.mesh.normals, job.options.curvature);
    const auto range = meshing::curvature_range(result.scaled_curvature, adjacency);
    const float factor = meshing::signed_factor(
        job.options.scale == meshing::CurvatureScale::Percentile
            ? meshing::curvature_quantile(result.scaled_curvature, adjacency, job.options.quantile)
            : range.greatest(),
        job.options.scale);
    for (float& h : result.scaled_curvature)
        h = meshing::scale_signed(h, factor);
    return result;
}

bool is_closed(const meshing::Adjacency& adjacency) {
    return std::find(adjacency.rim.begin(), adjacency.rim.end(), 1) == adjacency.rim.end();
}

void write_results(const WeatherJob& job, const TriMesh& start, const Weathering& run,
                   const Rows& rows, Progress* progress) {
    report_progress(progress, "writing files", 0.0);
    const WornMesh after = worn(job, run.mesh(), run.adjacency());
    meshing::MeshFile file{after.mesh, {}};
    if (job.curvature_colours)
        file.colours = meshing::curvature_colours(after.scaled_curvature, 1.0F);
    OutputBatch batch;
    write_staged_file(batch.stage(job.output), std::string_view(meshing::encode_mesh(
                                                   file, meshing::mesh_format_of(job.output))));
    if (rows.wanted())
        write_staged_file(batch.stage(job.csv), std::string_view(rows.text()));
    if (!job.before_after.empty() && !after.mesh.triangles.empty())
        vision::write_png(
            batch.stage(job.before_after),
            before_and_after(worn(job, start, meshing::build_adjacency(start)), after));
    if (!job.turntable.empty() && !after.mesh.triangles.empty())
        vision::write_png(batch.stage(job.turntable), turntable_of(after));
    batch.commit();
    report_progress(progress, "writing files", 1.0);
}

}  // namespace

WeatherOutcome run_weather_job(const WeatherJob& job, Progress* progress) {
    meshing::mesh_format_of(job.output);  // a wrong name costs no work
    std::error_code ignored;
    if (fs::equivalent(job.mesh, job.output, ignored))
        fail<InvalidInput>("the output ", job.output.string(), " is the mesh itself");
    if (!job.csv.empty() && (job.csv == job.output || fs::equivalent(job.mesh, job.csv, ignored)))
        fail<InvalidInput>("the rows ", job.csv.string(), " would take the place of a mesh");
    report_progress(progress, "reading the mesh", 0.0);
    TriMesh start = meshing::read_mesh(job.mesh).mesh;
    if (start.triangles.empty())
        fail<InvalidInput>("cannot weather ", job.mesh.string(), ": it holds points alone");
    WeatherOutcome outcome;
    outcome.cleaned = meshing::clean_mesh(start, job.clean);
    if (start.triangles.empty())
        fail<InvalidInput>("cannot weather ", job.mesh.string(),
                           ": none of its triangles has an area");
    Checkpoint checkpoint(job, start);
    outcome.resumed = checkpoint.exists();
    const auto run = outcome.resumed
                         ? std::make_unique<Weathering>(start, job.options, checkpoint.read())
                         : std::make_unique<Weathering>(start, job.options);
    outcome.volume_before = meshing::signed_volume(start);
    outcome.closed = is_closed(run->adjacency());
    Rows rows(job);
    rows.resume(*run);
    run_to_the_end(*run, checkpoint, rows, progress);
    write_results(job, start, *run, rows, progress);
    checkpoint.remove();
    outcome.report = run->report();
    outcome.n_vertices = run->mesh().positions.size();
    outcome.n_triangles = run->mesh().triangles.size();
    outcome.volume_after = meshing::signed_volume(run->mesh());
    return outcome;
}

std::string weather_text(const WeatherJob& job, const WeatherOutcome& outcome) {
    const terrain::WeatheringReport& r = outcome.report;
    std::ostringstream text;
    const std::string cleaned = meshing::clean_text(outcome.cleaned);
    if (!cleaned.empty())
        text << "cleaned: " << cleaned << '\n';
    text << job.output.string() << ": " << r.steps << " steps"
         << (outcome.resumed ? " in all, resumed" : "") << ", " << outcome.n_vertices
         << " vertices, " << outcome.n_triangles << " triangles\n";
    if (outcome.closed && outcome.volume_before > 0.0)
        text << "volume left: " << 100.0 * outcome.volume_after / outcome.volume_before << " %\n";
    if (r.n_collapsed > 0)
        text << "small edges collapsed: " << r.n_collapsed << '\n';
    if (r.restarts > 0)
        text << "went back " << r.restarts << " times to shorter steps: step limit " << r.step_limit
             << '\n';
    if (r.tested)
        text << "self-intersecting pairs of triangles: " << r.n_intersections << " (at the start "
             << r.n_at_start << (r.test_complete ? ")\n" : "); not all were looked at\n");
    else
        text << "self-intersections were not looked for\n";
    if (r.gave_up)
        text << "gave up: triangles " << r.tangle.a << " and " << r.tangle.b
             << " meet even with the shortest steps; this is the last clean mesh: raise "
                "--max-restarts or --step-limit\n";
    if (r.depends_on_units)
        text << "the greatest curvature is below 1 per unit of length, so the wear depends on the "
                "units: --scale always makes it independent\n";
    return text.str();
}

std::string weather_json(const WeatherJob& job, const WeatherOutcome& outcome) {
    const terrain::WeatheringReport& r = outcome.report;
    const nlohmann::ordered_json json = {
        {"mesh", job.mesh.string()},
        {"output", job.output.string()},
        {"steps", r.steps},
        {"dose", r.dose},
        {"dose_wanted", r.dose_wanted},
        {"step_limit", r.step_limit},
        {"restarts", r.restarts},
        {"resumed", outcome.resumed},
        {"gave_up", r.gave_up},
        {"vanished", r.vanished},
        {"self_intersections_tested", r.tested},
        {"self_intersections_complete", r.test_complete},
        {"self_intersections", r.n_intersections},
        {"self_intersections_at_start", r.n_at_start},
        {"edges_collapsed", r.n_collapsed},
        {"short_edges_blocked", r.n_blocked},
        {"vertices", outcome.n_vertices},
        {"triangles", outcome.n_triangles},
        {"closed", outcome.closed},
        {"volume_before_m3", outcome.volume_before},
        {"volume_after_m3", outcome.volume_after},
        {"curvature_low", r.last.range.low},
        {"curvature_high", r.last.range.high},
        {"depends_on_units", r.depends_on_units},
        {"cleaning",
         {{"welded", outcome.cleaned.n_welded},
          {"degenerate", outcome.cleaned.n_degenerate},
          {"duplicate", outcome.cleaned.n_duplicate},
          {"flipped", outcome.cleaned.n_flipped},
          {"cut_edges", outcome.cleaned.n_cut_edges},
          {"split_vertices", outcome.cleaned.n_split},
          {"unused_vertices", outcome.cleaned.n_unused}}},
        {"seconds",
         {{"steps", r.step_seconds}, {"small_faces", r.small_seconds}, {"tests", r.test_seconds}}}};
    return json.dump(2) + "\n";
}

}  // namespace scree::apps
