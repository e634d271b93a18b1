#include "terrain/surface/wet_erosion.h"

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "meshing/curvature/umbrella.h"
#include "meshing/mesh/normals.h"
#include "terrain/fluid/point_cells.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

using meshing::Adjacency;
using meshing::CurvatureRange;
using meshing::RimPolicy;
using meshing::TriMesh;

constexpr std::size_t kGrain = 1024;

// Share of the umbrella direction, from the signed curvature (`mesh-erosion.md` 7.4).
float umbrella_share(float h, const CurvatureRange& range) {
    if (h >= 0.0F)
        return range.high > 0.0F ? std::min(1.0F, h / range.high) : 0.0F;
    return range.low < 0.0F ? std::min(1.0F, h / range.low) : 0.0F;
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0F ? v / length : glm::vec3(0.0F);
}

void collect_wet(const Adjacency& adjacency, const WetErosionOptions& options,
                 WetErosionScratch& scratch, WetErosionReport& report) {
    scratch.wet.clear();
    for (std::size_t i = 0; i < scratch.factors.size(); ++i) {
        if (scratch.factors[i] <= 0.0F)
            continue;
        ++report.n_affected;
        if (adjacency.rim[i] == 0 || options.rim != RimPolicy::Pinned)
            scratch.wet.push_back(static_cast<std::uint32_t>(i));
    }
}

struct Move {
    const WetErosionOptions& options;
    const CurvatureRange& range;
    float limit;  // mean edge / x
};

// v + d f D with d = speed^n e/x and D = (1 - w)(-n) + w L; D is at most one long, so the limit
// holds. In the sound reading L's outward part is turned inwards.
glm::vec3 displacement(const Move& move, bool on_rim, const WetErosionScratch& s, std::size_t k) {
    const std::uint32_t i = s.wet[k];
    const float h = s.curvature[i];
    const glm::vec3& normal = s.normals[i];
    const float scaled = s.speeds[i];
    const float speed =
        move.options.power == 1.0
            ? scaled
            : static_cast<float>(std::pow(static_cast<double>(scaled), move.options.power));
    glm::vec3 inward = s.directions[k];
    if (move.options.concave == Reading::Sound)
        inward -= normal * (2.0F * std::max(0.0F, glm::dot(inward, normal)));
    const float share =
        on_rim && move.options.rim == RimPolicy::NormalOnly ? 0.0F : umbrella_share(h, move.range);
    const glm::vec3 direction = inward * share - normal * (1.0F - share);
    return direction * (speed * s.factors[i] * move.limit);
}

void move_wet(TriMesh& mesh, const Adjacency& adjacency, const Move& move,
              const WetErosionScratch& scratch, WetErosionReport& report) {
    struct Tally {
        std::size_t moved = 0;
        float greatest = 0.0F;
    };
    std::vector<Tally> tallies(scratch.wet.size() / kGrain + 1);
    parallel_for(0, scratch.wet.size(), kGrain, [&](std::size_t first, std::size_t last) {
        Tally& tally = tallies[first / kGrain];
        for (std::size_t k = first; k < last; ++k) {
            const std::uint32_t i = scratch.wet[k];
            const glm::vec3 by = displacement(move, adjacency.rim[i] != 0, scratch, k);
            const glm::vec3 before = mesh.positions[i];
            mesh.positions[i] += by;
            tally.moved += mesh.positions[i] != before ? 1 : 0;
            tally.greatest = std::max(tally.greatest, glm::length(by));
        }
    });
    for (const Tally& tally : tallies) {
        report.n_moved += tally.moved;
        report.greatest_move = std::max(report.greatest_move, static_cast<double>(tally.greatest));
    }
}

}  // namespace

void distance_factors(std::span<const glm::vec3> vertices, std::span<const glm::vec3> particles,
                      double reach, std::vector<float>& factors) {
    factors.assign(vertices.size(), 0.0F);
    if (particles.empty())
        return;
    const auto far = static_cast<float>(reach);
    const PointCells cells(particles, far);
    parallel_for_each_index(0, vertices.size(), kGrain, [&](std::size_t i) {
        const float squared = cells.nearest_squared(vertices[i], far);
        if (squared < far * far)
            factors[i] = std::max(0.0F, (far - std::sqrt(squared)) / far);
    });
}

WetErosionReport erode_wet(TriMesh& mesh, const Adjacency& adjacency,
                           std::span<const glm::vec3> colliding, const WetErosionOptions& options,
                           WetErosionScratch& s) {
    check(options);
    WetErosionReport report;
    Stopwatch watch;
    report.mean_edge = meshing::mean_edge_length(mesh, adjacency);
    if (!(report.mean_edge > 0.0))
        return report;
    distance_factors(mesh.positions, colliding, options.influence * report.mean_edge, s.factors);
    collect_wet(adjacency, options, s, report);
    report.affected_seconds = watch.lap();

    s.normals.resize(mesh.positions.size());
    s.curvature.resize(mesh.positions.size());
    meshing::vertex_normals(mesh, adjacency, meshing::NormalWeight::Sphere, s.normals);
    meshing::mean_curvature(mesh, adjacency, s.normals, options.curvature, s.estimator,
                            s.curvature);
    const CurvatureRange range = meshing::curvature_range(s.curvature, adjacency);
    s.speeds = meshing::scale_unsigned(s.curvature, range, options.range);
    report.least_curvature = static_cast<double>(range.low);
    report.greatest_curvature = static_cast<double>(range.high);
    report.curvature_seconds = watch.lap();

    s.directions.resize(s.wet.size());
    parallel_for_each_index(0, s.wet.size(), kGrain, [&](std::size_t k) {
        s.directions[k] = unit_or_zero(meshing::umbrella_vector(mesh, adjacency, s.wet[k]));
    });
    report.laplacian_seconds = watch.lap();

    const Move move{options, range, static_cast<float>(report.mean_edge / options.step_limit)};
    move_wet(mesh, adjacency, move, s, report);
    report.displacement_seconds = watch.lap();
    return report;
}

}  // namespace scree::terrain
