#include "apps/erosion_rows.h"

#include "meshing/mesh/tri_mesh.h"

namespace scree::apps {
namespace {

std::string header(bool times) {
    std::string names =
        "step,step_limit,restarts,mean_edge_m,curvature_low,curvature_high,affected,farthest_m,"
        "volume_m3,area_m2,vertices,triangles,self_intersections,particles,touching";
    if (times)
        names +=
            ",iteration_ms,affected_ms,curvature_ms,laplacian_ms,displacement_ms,fluid_ms,upkeep_"
            "ms";
    return names;
}

}  // namespace

ErosionRows::ErosionRows(const std::filesystem::path& file, bool times)
    : log_(file, header(times)), times_(times) {}

void ErosionRows::resume(const terrain::ErosionRun& run) {
    log_.resume(run.report.steps);
    before_ = run.report.times;
}

void ErosionRows::add(const terrain::ErosionRun& run) {
    const terrain::ErosionReport& report = run.report;
    const terrain::ErosionStep& last = report.last;
    CsvRow row;
    row.put(run.step_limit).put(report.restarts).put(last.mean_edge);
    row.put(last.least_curvature).put(last.greatest_curvature).put(last.n_affected);
    row.put(last.farthest).put(meshing::signed_volume(run.mesh));
    row.put(meshing::surface_area(run.mesh)).put(run.mesh.positions.size());
    row.put(run.mesh.triangles.size()).put(report.intersections);
    row.put(last.n_particles).put(last.n_touching);
    using Times = terrain::ErosionTimes;
    for (double Times::*column :
         {&Times::iteration, &Times::affected, &Times::curvature, &Times::laplacian,
          &Times::displacement, &Times::fluid, &Times::upkeep})
        if (times_)
            row.put(1e3 * (report.times.*column - before_.*column));
    before_ = report.times;
    log_.add(report.steps, row.text());
}

}  // namespace scree::apps
