#include "terrain/surface/wet_erosion.h"

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "meshing/mesh/normals.h"
#include "terrain/fluid/point_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

using meshing::Adjacency;
using meshing::RimPolicy;
using meshing::TriMesh;

constexpr std::size_t kGrain = 1024;
constexpr float kFlatShare = -0.05F;  // least over greatest magnitude from which hollows count

struct CurvatureRange {
    float least = 0.0F;
    float greatest = 0.0F;
};

// On a rim the estimate is one-sided, so it takes no part.
CurvatureRange range_of(const std::vector<float>& curvature, const Adjacency& adjacency) {
    CurvatureRange range{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
    for (std::size_t i = 0; i < curvature.size(); ++i)
        if (adjacency.rim[i] == 0) {
            range.least = std::min(range.least, curvature[i]);
            range.greatest = std::max(range.greatest, curvature[i]);
        }
    return range.least <= range.greatest ? range : CurvatureRange{};
}

// Unsigned scaling (`mesh-erosion.md` 2.3), 0 to 1.
class SpeedScale {
public:
    SpeedScale(const CurvatureRange& range, WetRange how) : range_(range) {
        magnitude_ = std::max(std::abs(range.least), std::abs(range.greatest));
        symmetric_ = how == WetRange::Symmetric ||
                     (how == WetRange::Auto && range.least >= kFlatShare * magnitude_);
    }
    float operator()(float h) const {
        const float low = symmetric_ ? -magnitude_ : range_.least;
        const float high = symmetric_ ? magnitude_ : range_.greatest;
        return high > low ? std::clamp((h - low) / (high - low), 0.0F, 1.0F) : 0.5F;
    }

private:
    CurvatureRange range_;
    float magnitude_ = 0.0F;
    bool symmetric_ = false;
};

// Share of the umbrella direction, from the signed curvature (`mesh-erosion.md` 7.4).
float umbrella_share(float h, const CurvatureRange& range) {
    if (h >= 0.0F)
        return range.greatest > 0.0F ? std::min(1.0F, h / range.greatest) : 0.0F;
    return range.least < 0.0F ? std::min(1.0F, h / range.least) : 0.0F;
}

glm::vec3 umbrella_direction(const TriMesh& mesh, const Adjacency& adjacency, std::size_t vertex) {
    const glm::vec3 at = mesh.positions[vertex];
    glm::vec3 sum(0.0F);
    for (const std::uint32_t j : adjacency.neighbours_of(vertex))
        sum += mesh.positions[j] - at;
    const float length = glm::length(sum);
    return length > 0.0F ? sum / length : glm::vec3(0.0F);
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
    const SpeedScale speed;
    float limit;  // mean edge / x
};

// v + d f D with d = speed^n e/x and D = (1 - w)(-n) + w L; D is at most one long, so the limit
// holds. In the sound reading L's outward part is turned inwards.
glm::vec3 displacement(const Move& move, bool on_rim, const WetErosionScratch& s, std::size_t k) {
    const std::uint32_t i = s.wet[k];
    const float h = s.curvature[i];
    const glm::vec3& normal = s.normals[i];
    const float scaled = move.speed(h);
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
    const CurvatureRange range = range_of(s.curvature, adjacency);
    report.least_curvature = static_cast<double>(range.least);
    report.greatest_curvature = static_cast<double>(range.greatest);
    report.curvature_seconds = watch.lap();

    s.directions.resize(s.wet.size());
    parallel_for_each_index(0, s.wet.size(), kGrain, [&](std::size_t k) {
        s.directions[k] = umbrella_direction(mesh, adjacency, s.wet[k]);
    });
    report.laplacian_seconds = watch.lap();

    const Move move{options, range, SpeedScale(range, options.range),
                    static_cast<float>(report.mean_edge / options.step_limit)};
    move_wet(mesh, adjacency, move, s, report);
    report.displacement_seconds = watch.lap();
    return report;
}

}  // namespace scree::terrain
