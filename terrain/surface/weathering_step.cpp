#include "terrain/surface/weathering_step.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/wedges.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

using meshing::Adjacency;
using meshing::TriMesh;
using meshing::Wedge;

constexpr std::size_t kGrain = 1024;

// What a piece of the vertices adds up to.
struct PieceSums {
    double edges = 0.0;  // lengths
    float low = 0.0F;
    float high = 0.0F;
    bool has_range = false;
    std::size_t n_moved = 0;
    double farthest = 0.0;  // squared
};

void resize(StepScratch& scratch, const TriMesh& mesh) {
    const std::size_t n = mesh.positions.size();
    scratch.normals.resize(n);
    scratch.umbrella.resize(n);
    scratch.curvature.resize(n);
    scratch.corner_shares.resize(3 * mesh.triangles.size());
    scratch.of_faces.of_triangles.resize(mesh.triangles.size());
}

template <class Body>
std::vector<PieceSums> for_each_piece(std::size_t n, Body&& body) {
    std::vector<PieceSums> sums((n + kGrain - 1) / kGrain);
    parallel_for_each_index(0, sums.size(), 1, [&](std::size_t i) {
        body(i * kGrain, std::min(n, (i + 1) * kGrain), sums[i]);
    });
    return sums;
}

// Normal, umbrella vector and shares of area of one vertex, from one walk around it; the numbers
// are those of vertex_normals(), umbrella_vector() and corner_area().
double look_around(const TriMesh& mesh, const Adjacency& adjacency, std::size_t v,
                   StepScratch& scratch) {
    glm::dvec3 normal(0.0);
    double area = 0.0;
    double unit =
        0.0;  // one over the size of the first triangle: areas may be too small for floats
    float* const shares = scratch.corner_shares.data() + adjacency.first_corner[v];
    std::size_t n_corners = 0;
    meshing::for_each_wedge(mesh, adjacency, v, [&](const Wedge& wedge) {
        const glm::dvec3 across = wedge.normal();
        const double square = glm::dot(across, across);
        const double lengths = wedge.aa * wedge.bb;
        double share = 0.0;
        if (unit == 0.0 && lengths > 0.0)
            unit = 1.0 / (wedge.aa + wedge.bb);
        if (square > 1e-24 * lengths)
            share = unit * meshing::corner_area(wedge, std::sqrt(square));
        if (lengths > 0.0)
            normal += across / lengths;
        shares[n_corners++] = static_cast<float>(share);
        area += share;
    });
    const float whole = area > 0.0 ? static_cast<float>(1.0 / area) : 0.0F;
    for (std::size_t j = 0; j < n_corners; ++j)
        shares[j] *= whole;
    const double square = glm::dot(normal, normal);
    scratch.normals[v] = square > 0.0 && std::isfinite(square)
                             ? glm::vec3(normal / std::sqrt(square))
                             : glm::vec3(0.0F);

    const glm::dvec3 here(mesh.positions[v]);
    glm::dvec3 sum(0.0);
    double edges = 0.0;
    const auto ring = adjacency.neighbours_of(v);
    for (const std::uint32_t other : ring) {
        const glm::dvec3 edge = glm::dvec3(mesh.positions[other]) - here;
        sum += edge;
        if (other > v)
            edges += std::sqrt(glm::dot(edge, edge));
    }
    scratch.umbrella[v] =
        ring.empty() ? glm::vec3(0.0F) : glm::vec3(sum / static_cast<double>(ring.size()));
    return edges;
}

void note_curvature(const Adjacency& adjacency, std::size_t v, float h, PieceSums& sums) {
    if (adjacency.rim[v] != 0)
        return;
    sums.low = sums.has_range ? std::min(sums.low, h) : h;
    sums.high = sums.has_range ? std::max(sums.high, h) : h;
    sums.has_range = true;
}

// The tensor estimate with the shares of area that the first walk left.
std::vector<PieceSums> gather_curvature(const Adjacency& adjacency, StepScratch& scratch) {
    return for_each_piece(scratch.curvature.size(),
                          [&](std::size_t first, std::size_t last, PieceSums& sums) {
                              const std::vector<float>& of_faces = scratch.of_faces.of_triangles;
                              for (std::size_t v = first; v < last; ++v) {
                                  double h = 0.0;
                                  for (std::uint32_t c = adjacency.first_corner[v];
                                       c < adjacency.first_corner[v + 1]; ++c)
                                      h += static_cast<double>(scratch.corner_shares[c]) *
                                           static_cast<double>(of_faces[adjacency.corners[c] / 3]);
                                  scratch.curvature[v] = static_cast<float>(h);
                                  note_curvature(adjacency, v, scratch.curvature[v], sums);
                              }
                          });
}

std::vector<PieceSums> measure_curvature(const TriMesh& mesh, const Adjacency& adjacency,
                                         const StepRules& rules, StepScratch& scratch) {
    if (rules.curvature == meshing::CurvatureMethod::Tensor) {
        meshing::face_mean_curvatures(mesh, scratch.normals, scratch.of_faces.of_triangles);
        return gather_curvature(adjacency, scratch);
    }
    meshing::mean_curvature(mesh, adjacency, scratch.normals, rules.curvature, scratch.of_faces,
                            scratch.curvature);
    return for_each_piece(scratch.curvature.size(),
                          [&](std::size_t first, std::size_t last, PieceSums& sums) {
                              for (std::size_t v = first; v < last; ++v)
                                  note_curvature(adjacency, v, scratch.curvature[v], sums);
                          });
}

meshing::CurvatureRange join_ranges(const std::vector<PieceSums>& pieces) {
    meshing::CurvatureRange range;
    bool first = true;
    for (const PieceSums& piece : pieces) {
        if (!piece.has_range)
            continue;
        range.low = first ? piece.low : std::min(range.low, piece.low);
        range.high = first ? piece.high : std::max(range.high, piece.high);
        first = false;
    }
    return range;
}

float choose_factor(const TriMesh& mesh, const Adjacency& adjacency, const StepRules& rules,
                    const StepScratch& scratch, const meshing::CurvatureRange& range) {
    if (rules.frozen_factor > 0.0F)
        return rules.frozen_factor;
    if (rules.scale == meshing::CurvatureScale::DownscaleOnly)
        return meshing::signed_factor(range.greatest(), rules.scale);
    glm::vec3 low(mesh.positions.front());
    glm::vec3 high = low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const float floor = 1e-3F / std::max(glm::distance(low, high), 1e-30F);
    const float greatest =
        rules.scale == meshing::CurvatureScale::Percentile
            ? meshing::curvature_quantile(scratch.curvature, adjacency, rules.quantile)
            : range.greatest();
    return meshing::signed_factor(greatest, rules.scale, floor);
}

// Where one vertex goes, as a unit vector; as it comes in the literal reading.
glm::dvec3 direction_of(const StepScratch& scratch, bool on_rim, std::size_t v,
                        const StepRules& rules) {
    const bool along_normal = rules.direction == WearDirection::Normal ||
                              (on_rim && rules.rim == meshing::RimPolicy::NormalOnly);
    if (along_normal)
        return -glm::dvec3(scratch.normals[v]);
    const glm::dvec3 umbrella(scratch.umbrella[v]);
    if (rules.reading == Reading::Literal)
        return umbrella;
    const double square = glm::dot(umbrella, umbrella);
    return square > 0.0 ? umbrella / std::sqrt(square) : glm::dvec3(0.0);
}

// Equations 3 to 5: d = h^n e_avg / x where h > 0.
std::vector<PieceSums> move_vertices(TriMesh& mesh, const Adjacency& adjacency,
                                     const StepRules& rules, const StepScratch& scratch,
                                     const StepReport& report) {
    const double limit = report.mean_edge / rules.step_limit;
    // Rounding a moved position to float must not carry it past the limit.
    const double reach = limit * (1.0 - 1e-6);
    return for_each_piece(mesh.positions.size(), [&](std::size_t first, std::size_t last,
                                                     PieceSums& sums) {
        for (std::size_t v = first; v < last; ++v) {
            const bool on_rim = adjacency.rim[v] != 0;
            const float h = meshing::scale_signed(scratch.curvature[v], report.factor);
            if (!(h > 0.0F) || (on_rim && rules.rim == meshing::RimPolicy::Pinned))
                continue;
            const double share = rules.power == 1.0 ? static_cast<double>(h)
                                                    : std::pow(static_cast<double>(h), rules.power);
            const glm::dvec3 move = (share * reach) * direction_of(scratch, on_rim, v, rules);
            mesh.positions[v] = glm::vec3(glm::dvec3(mesh.positions[v]) + move);
            const double square = glm::dot(move, move);
            sums.farthest = std::max(sums.farthest, square);
            sums.n_moved += square > 0.0 ? 1 : 0;
        }
    });
}

}  // namespace

StepReport weathering_step(TriMesh& mesh, const Adjacency& adjacency, const StepRules& rules,
                           StepScratch& scratch) {
    if (adjacency.n_vertices() != mesh.positions.size() ||
        adjacency.corners.size() != 3 * mesh.triangles.size())
        fail<InvalidInput>("the mesh has ", mesh.positions.size(), " vertices and ",
                           mesh.triangles.size(), " triangles, its adjacency ",
                           adjacency.n_vertices(), " and ", adjacency.corners.size() / 3);
    StepReport report;
    if (mesh.triangles.empty())
        return report;
    resize(scratch, mesh);
    const auto walked = for_each_piece(
        mesh.positions.size(), [&](std::size_t first, std::size_t last, PieceSums& sums) {
            for (std::size_t v = first; v < last; ++v)
                sums.edges += look_around(mesh, adjacency, v, scratch);
        });
    for (const PieceSums& piece : walked)
        report.mean_edge += piece.edges;
    report.mean_edge /= static_cast<double>(adjacency.n_edges());
    report.range = join_ranges(measure_curvature(mesh, adjacency, rules, scratch));
    report.factor = choose_factor(mesh, adjacency, rules, scratch, report.range);
    for (const PieceSums& piece : move_vertices(mesh, adjacency, rules, scratch, report)) {
        report.n_moved += piece.n_moved;
        report.farthest = std::max(report.farthest, piece.farthest);
    }
    report.farthest = std::sqrt(report.farthest);
    return report;
}

}  // namespace scree::terrain
