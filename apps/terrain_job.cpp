#include "apps/terrain_job.h"

#include "apps/erosion_pictures.h"
#include "base/error.h"
#include "base/whole_file.h"
#include "meshing/io/mesh_io.h"
#include "meshing/io/point_io.h"
#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/bounds.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;
using terrain::GroundLattice;

constexpr std::size_t kLargestBeds = std::size_t{1} << 20U;

bool holds_points(const fs::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".ply" || ending == ".las" || ending == ".laz";
}

// +Y up; a survey's north is -z.
void turn_up(std::vector<glm::dvec3>& points) {
    for (glm::dvec3& p : points)
        p = {p.x, p.z, -p.y};
}

bool z_is_up(const TerrainJob& job) {
    return job.up == PointsUp::Z ||
           (job.up == PointsUp::Auto &&
            meshing::point_format_of(job.input) == meshing::PointFormat::Las);
}

GroundLattice read_survey(const TerrainJob& job, TerrainOutcome& outcome) {
    meshing::PointCloud cloud = meshing::read_points(job.input);
    if (z_is_up(job))
        turn_up(cloud.points);
    return terrain::lattice_of_points(cloud.points, cloud.classes,
                                      terrain::places_for(job.mesh, cloud.points.size()),
                                      job.survey, &outcome.survey);
}

GroundLattice read_lattice(const TerrainJob& job, TerrainOutcome& outcome) {
    outcome.of_points = holds_points(job.input);
    if (outcome.of_points) {
        if (job.scale.width_m > 0.0 || job.scale.height_m > 0.0)
            fail<InvalidInput>(job.input.string(),
                               " holds points, which are in metres; leave --width-m and "
                               "--height-m out");
        return read_survey(job, outcome);
    }
    const terrain::Heightfield field = read_ground(job.input, job.scale);
    return terrain::lattice_of(field, terrain::places_for(job.mesh, field.heights.size()));
}

// The file's own coordinates to those of the mesh.
void place_line(const TerrainJob& job, const TerrainOutcome& outcome, terrain::RiverBed& bed) {
    if (!outcome.of_points)
        return;
    const bool turned = z_is_up(job);
    for (glm::dvec2& p : bed.line)
        p = glm::dvec2(p.x, turned ? -p.y : p.y) - outcome.survey.moved;
}

void cut_beds(const TerrainJob& job, GroundLattice& ground, TerrainOutcome& outcome) {
    if (job.beds.empty())
        return;
    const std::string text = read_whole_file(job.beds, kLargestBeds);
    for (terrain::RiverBed& bed : terrain::beds_from_json(text, job.beds.string())) {
        place_line(job, outcome, bed);
        outcome.beds.push_back(terrain::cut_bed(ground, bed));
    }
}

void write_results(const TerrainJob& job, const meshing::TriMesh& mesh) {
    OutputBatch batch;
    write_staged_file(
        batch.stage(job.output),
        std::string_view(meshing::encode_mesh({mesh, {}}, meshing::mesh_format_of(job.output))));
    if (!job.picture.empty()) {
        const meshing::Box box = meshing::bounding_box(mesh);
        const float base =
            box.min.y - 0.02F * std::max(box.max.x - box.min.x, box.max.z - box.min.z);
        vision::write_png(batch.stage(job.picture), picture_of_ground(mesh, base, {}));
    }
    batch.commit();
}

}  // namespace

TerrainOutcome run_terrain_job(const TerrainJob& job, Progress* progress) {
    meshing::mesh_format_of(job.output);  // a wrong name costs no work
    std::error_code ignored;
    if (fs::equivalent(job.input, job.output, ignored))
        fail<InvalidInput>("the output ", job.output.string(), " is the input itself");
    TerrainOutcome outcome;
    report_progress(progress, "reading the ground", 0.0);
    GroundLattice ground = read_lattice(job, outcome);
    outcome.n_places = ground.heights.size();
    report_progress(progress, "cutting beds", 0.0);
    cut_beds(job, ground, outcome);
    report_progress(progress, "making the mesh", 0.0);
    const meshing::TriMesh mesh = terrain::terrain_mesh(ground, job.mesh);
    outcome.n_vertices = mesh.positions.size();
    outcome.n_triangles = mesh.triangles.size();
    outcome.mean_edge = meshing::mean_edge_length(mesh, meshing::build_adjacency(mesh));
    report_progress(progress, "writing files", 0.0);
    write_results(job, mesh);
    return outcome;
}

std::string terrain_text(const TerrainJob& job, const TerrainOutcome& outcome) {
    std::ostringstream text;
    text.precision(9);
    const terrain::SurveyReport& survey = outcome.survey;
    if (outcome.of_points) {
        text << "survey: " << survey.n_points << " points, " << survey.n_ground << " of ground, "
             << survey.n_thinned << " after thinning";
        if (survey.n_steep > 0)
            text << ", " << survey.n_steep << " of them too steep";
        text << "\nmoved: x = " << survey.moved.x << " and z = " << survey.moved.y
             << " of the survey became 0\n";
    }
    for (const terrain::BedReport& bed : outcome.beds)
        text << "bed: " << bed.length << " m long, up to " << bed.deepest << " m deep, "
             << bed.n_lowered << " places lowered\n";
    text << job.output.string() << ": " << outcome.n_vertices << " vertices, "
         << outcome.n_triangles << " triangles, mean edge " << outcome.mean_edge << " m\n";
    if (outcome.n_vertices > static_cast<std::size_t>(job.mesh.vertices))
        text << "fewer vertices would have turned a triangle over\n";
    return text.str();
}

std::string terrain_json(const TerrainJob& job, const TerrainOutcome& outcome) {
    nlohmann::ordered_json json = {
        {"input", job.input.string()},      {"output", job.output.string()},
        {"vertices", outcome.n_vertices},   {"triangles", outcome.n_triangles},
        {"mean_edge_m", outcome.mean_edge}, {"places_sampled", outcome.n_places}};
    if (outcome.of_points)
        json["survey"] = {{"points", outcome.survey.n_points},
                          {"ground", outcome.survey.n_ground},
                          {"thinned", outcome.survey.n_thinned},
                          {"too_steep", outcome.survey.n_steep},
                          {"area_m2", outcome.survey.area},
                          {"moved_m", {outcome.survey.moved.x, outcome.survey.moved.y}}};
    json["beds"] = nlohmann::ordered_json::array();
    for (const terrain::BedReport& bed : outcome.beds)
        json["beds"].push_back({{"length_m", bed.length},
                                {"deepest_m", bed.deepest},
                                {"places_lowered", bed.n_lowered}});
    return json.dump(2) + "\n";
}

}  // namespace scree::apps
