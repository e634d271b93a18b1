#include "apps/erosion_job.h"

#include "apps/erosion_pictures.h"
#include "apps/erosion_rows.h"
#include "base/error.h"
#include "base/whole_file.h"
#include "meshing/gltf/gltf_morph.h"
#include "meshing/gltf/gltf_write.h"
#include "meshing/io/mesh_io.h"
#include "meshing/mesh/bounds.h"
#include "meshing/mesh/cleaning.h"
#include "meshing/mesh/normals.h"
#include "terrain/fluid/particle_ply.h"
#include "terrain/surface/erosion_checkpoint.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <system_error>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;
using meshing::TriMesh;
using terrain::ErosionRun;
using terrain::ErosionScene;
using terrain::StepCsv;

constexpr std::size_t kLargestScene = std::size_t{1} << 20;
constexpr std::size_t kLargestCheckpoint = std::size_t{1} << 32;
constexpr std::size_t kMorphShapes = 4;
constexpr const char* kCheckpoint = "checkpoint.bin";
constexpr const char* kSteps = "steps.csv";

// An oriented manifold in metres; `repairs` says what had to be done for that.
TriMesh load_mesh(const ErosionScene& scene, const fs::path& scene_file, std::string& repairs) {
    if (scene.mesh_file.empty())
        return terrain::make_ground(scene.ground);
    const fs::path path = scene_file.parent_path() / scene.mesh_file;
    TriMesh mesh = meshing::read_mesh(path).mesh;
    repairs = meshing::clean_text(meshing::clean_mesh(mesh, {.weld = true}));
    if (mesh.triangles.empty())
        fail<InvalidInput>(path.string(), " holds no triangle; a scene takes a mesh of some");
    return mesh;
}

std::vector<std::uint8_t> glb_of(const TriMesh& mesh, const meshing::Adjacency& adjacency,
                                 const std::string& name) {
    TriMesh shaded = mesh;
    shaded.texcoords.clear();
    shaded.normals = meshing::vertex_normals(mesh, adjacency);
    for (glm::vec3& n : shaded.normals)
        n = n == glm::vec3(0.0F) ? glm::vec3(0, 1, 0) : n;  // glTF takes unit vectors alone
    meshing::GltfScene scene;
    scene.name = name;
    scene.meshes.push_back({name, std::move(shaded)});
    meshing::GltfNode node;
    node.name = name;
    node.mesh = 0;
    scene.nodes.push_back(std::move(node));
    return meshing::encode_glb(std::move(scene), {.reorder = false});
}

std::string numbered(const char* folder, int step, const char* ending) {
    char name[80];
    std::snprintf(name, sizeof name, "%s/step_%06d.%s", folder, step, ending);
    return name;
}

// Writes what a run gives on its way.
class Recorder {
public:
    Recorder(const ErosionJob& job, const ErosionScene& scene, const std::string& text)
        : job_(job),
          scene_(scene),
          text_(text),
          rows_(job.folder / kSteps, scene.output.csv == StepCsv::Times) {}

    void start(const TriMesh& mesh) {
        first_ = mesh.positions;
        shapes_.push_back({"first", mesh.positions});
    }

    void after_step(const ErosionRun& run) {
        const int step = run.report.steps;
        const terrain::ErosionOutput& out = scene_.output;
        if (out.csv != StepCsv::None)
            rows_.add(run);
        if (out.mesh_every > 0 && step % out.mesh_every == 0)
            write(numbered("meshes", step, "glb"),
                  glb_of(run.mesh, meshing::build_adjacency(run.mesh), "ground"));
        if (out.particles_every > 0 && step % out.particles_every == 0) {
            const std::string name = numbered("particles", step, "ply");
            write_whole_file(job_.folder / name, terrain::particles_as_ply(run.fluid));
            note(name);
        }
        if (out.checkpoint_every > 0 && run.sound &&
            step - last_checkpoint_ >= out.checkpoint_every) {
            if (out.csv != StepCsv::None) {
                write_whole_file(job_.folder / kSteps, rows_.text());
                note(kSteps);
            }
            write(kCheckpoint, terrain::encode_checkpoint(run, text_));
            last_checkpoint_ = step;
        }
        const int stride = std::max(1, scene_.run.steps / static_cast<int>(kMorphShapes));
        if (out.morph && step % stride == 0 && shapes_.size() < kMorphShapes &&
            run.mesh.positions.size() == first_.size())
            shapes_.push_back({"step_" + std::to_string(step), run.mesh.positions});
    }

    void went_on_from(const ErosionRun& run) {
        last_checkpoint_ = run.report.steps;
        if (scene_.output.csv != StepCsv::None)
            rows_.resume(run);
    }

    const std::vector<glm::vec3>& first() const { return first_; }
    std::vector<meshing::MorphShape> shapes() const { return shapes_; }
    std::vector<std::string> files() const { return files_; }
    std::string rows() const { return rows_.text(); }

private:
    void write(const std::string& name, const std::vector<std::uint8_t>& bytes) {
        write_whole_file(job_.folder / name, bytes);
        note(name);
    }
    void note(const std::string& name) {
        if (std::find(files_.begin(), files_.end(), name) == files_.end())
            files_.push_back(name);
    }

    const ErosionJob& job_;
    const ErosionScene& scene_;
    const std::string& text_;
    std::vector<glm::vec3> first_;
    std::vector<meshing::MorphShape> shapes_;
    std::vector<std::string> files_;
    ErosionRows rows_;
    int last_checkpoint_ = 0;
};

// A little below both, so that their pictures show the same block.
float base_below(const TriMesh& before, const TriMesh& after) {
    const meshing::Box a = meshing::bounding_box(before);
    const meshing::Box b = meshing::bounding_box(after);
    return std::min(a.min.y, b.min.y) - 0.1F * (a.max.y - a.min.y);
}

void write_results(const ErosionJob& job, const ErosionScene& scene, const TriMesh& first,
                   const ErosionRun& run, const Recorder& recorder, ErosionOutcome& outcome) {
    OutputBatch batch;
    const auto stage = [&](const std::string& name) {
        if (std::find(outcome.files.begin(), outcome.files.end(), name) == outcome.files.end())
            outcome.files.push_back(name);
        return batch.stage(job.folder / name);
    };
    outcome.files = recorder.files();
    if (scene.output.csv != StepCsv::None)
        write_staged_file(stage(kSteps), recorder.rows());
    write_staged_file(stage("ground.glb"),
                      glb_of(run.mesh, meshing::build_adjacency(run.mesh), "ground"));
    const bool same = run.mesh.triangles == first.triangles;
    if (scene.output.morph && same)
        write_staged_file(stage("morph.glb"),
                          meshing::encode_morph_glb({"ground", run.mesh, recorder.shapes(), 4.0}));
    if (scene.output.pictures) {
        const float base = base_below(first, run.mesh);
        const terrain::ErosionOutput& view = scene.output;
        vision::write_png(stage("before.png"), picture_of_ground(first, base, view));
        vision::write_png(stage("after.png"), picture_of_ground(run.mesh, base, view));
        vision::write_png(stage("water.png"),
                          picture_of_erosion(run.mesh, first.positions, base, run.fluid, view));
    }
    const fs::path report = stage("report.json");
    write_staged_file(report, erosion_json(outcome));
    batch.commit();
}

ErosionRun begin_run(const ErosionJob& job, const TriMesh& mesh, const std::string& text,
                     ErosionOutcome& outcome) {
    const fs::path checkpoint = job.folder / kCheckpoint;
    std::error_code ignored;
    if (job.resume && fs::exists(checkpoint, ignored)) {
        const std::string bytes = read_whole_file(checkpoint, kLargestCheckpoint);
        outcome.resumed = checkpoint.string();
        return terrain::decode_checkpoint(
            std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), text,
            checkpoint.string());
    }
    ErosionRun run;
    run.mesh.positions = mesh.positions;
    run.mesh.triangles = mesh.triangles;
    return run;
}

void take_figures(const ErosionRun& run, const ErosionScene& scene, ErosionOutcome& outcome) {
    outcome.n_vertices = run.mesh.positions.size();
    outcome.n_triangles = run.mesh.triangles.size();
    outcome.tally = run.fluid.tally;
    outcome.report = run.report;
    outcome.scripted = scene.fluid_kind == terrain::FluidKind::Scripted;
    outcome.scheme = scene.run.scheme;
    outcome.sediment_carried = run.sediment.carried_sum();
    outcome.sediment_pending = run.sediment.pending_sum();
    outcome.sediment_lost = run.sediment.lost;
    outcome.sediment_eroded = run.sediment.eroded;
    outcome.sediment_deposited = run.sediment.deposited;
}

}  // namespace

ErosionOutcome run_erosion_job(const ErosionJob& job, Progress* progress) {
    const std::string text = read_whole_file(job.scene, kLargestScene);
    const ErosionScene scene = terrain::erosion_scene_from_json(text, job.scene.string());
    ErosionOutcome outcome;
    const TriMesh mesh = load_mesh(scene, job.scene, outcome.repairs);
    const auto fluid = terrain::make_fluid(scene);
    ErosionRun run = begin_run(job, mesh, text, outcome);
    Recorder recorder(job, scene, text);
    recorder.start(mesh);
    recorder.went_on_from(run);
    terrain::ErosionHooks hooks;
    hooks.after_step = [&](const ErosionRun& now) { recorder.after_step(now); };
    hooks.progress = progress;
    terrain::run_erosion(run, *fluid, scene.run, scene.wear, scene.sediment, hooks);
    report_progress(progress, "writing files", 0.0);
    take_figures(run, scene, outcome);
    write_results(job, scene, mesh, run, recorder, outcome);
    return outcome;
}

std::string erosion_text(const ErosionOutcome& outcome, const fs::path& folder) {
    const terrain::ErosionReport& r = outcome.report;
    const double per_step = r.steps > 0 ? 1e3 / r.steps : 0.0;
    char text[640];
    std::snprintf(
        text, sizeof text,
        "%d steps on %zu vertices: %.0f particles, %.0f touching, %.0f vertices wet\n"
        "a step took %.1f ms: fluid %.1f, affected %.2f, curvature %.2f, Laplacian %.2f, "
        "displacement %.2f, upkeep %.1f\n"
        "volume %+.4g m3; step limit %.3g after %d restarts, %zu self-intersections%s\n",
        r.steps, outcome.n_vertices, r.mean_particles, r.mean_touching, r.mean_affected,
        r.times.iteration * per_step, r.times.fluid * per_step, r.times.affected * per_step,
        r.times.curvature * per_step, r.times.laplacian * per_step, r.times.displacement * per_step,
        r.times.upkeep * per_step, r.volume - r.volume_before, r.step_limit, r.restarts,
        r.intersections, r.finished ? "" : "; stopped early, it would tangle: raise step_limit");
    return (outcome.repairs.empty() ? "" : "repaired: " + outcome.repairs + "\n") + text +
           std::to_string(outcome.files.size()) + " files in " + folder.string() + "\n";
}

std::string erosion_json(const ErosionOutcome& o) {
    const terrain::ErosionReport& r = o.report;
    const double per_step = r.steps > 0 ? 1e3 / r.steps : 0.0;
    nlohmann::ordered_json json = {{"format", "scree-erosion-report"},
                                   {"version", 1},
                                   {"finished", r.finished},
                                   {"steps", r.steps},
                                   {"vertices", o.n_vertices},
                                   {"triangles", o.n_triangles},
                                   {"mean_particles", r.mean_particles},
                                   {"mean_touching", r.mean_touching},
                                   {"mean_affected", r.mean_affected},
                                   {"step_limit", r.step_limit},
                                   {"restarts", r.restarts},
                                   {"self_intersections_before", r.intersections_before},
                                   {"self_intersections", r.intersections},
                                   {"edges_collapsed", r.n_collapsed},
                                   {"volume_before_m3", r.volume_before},
                                   {"volume_m3", r.volume},
                                   {"milliseconds_per_step",
                                    {{"iteration", r.times.iteration * per_step},
                                     {"affected_vertices", r.times.affected * per_step},
                                     {"curvature", r.times.curvature * per_step},
                                     {"laplacian", r.times.laplacian * per_step},
                                     {"displacement", r.times.displacement * per_step},
                                     {"fluid", r.times.fluid * per_step},
                                     {"upkeep", r.times.upkeep * per_step}}},
                                   {"particles",
                                    {{"emitted", o.tally.emitted},
                                     {"left_domain", o.tally.left_domain},
                                     {"drained", o.tally.drained},
                                     {"blocked", o.tally.blocked},
                                     {"refused", o.tally.refused}}}};
    if (o.scheme == terrain::ErosionScheme::Sediment)
        json["sediment_m3"] = {{"eroded", o.sediment_eroded},
                               {"deposited", o.sediment_deposited},
                               {"carried", o.sediment_carried},
                               {"lost", o.sediment_lost},
                               {"pending", o.sediment_pending}};
    if (!o.repairs.empty())
        json["repairs"] = o.repairs;
    if (!o.resumed.empty())
        json["resumed"] = o.resumed;
    json["files"] = o.files;
    return json.dump(1) + "\n";
}

}  // namespace scree::apps
