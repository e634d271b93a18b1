#include "vision/thesis/slice_tracer.h"

#include "vision/thesis/contour_gaps.h"
#include "vision/thesis/polygon.h"
#include "vision/thesis/turning_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace scree::vision {
namespace {

using Ray = RayPolygon::Ray;

double least_distance(const std::vector<glm::dvec2>& points, glm::dvec2 centre) {
    double least = std::numeric_limits<double>::max();
    for (const glm::dvec2 p : points)
        least = std::min(least, glm::distance(p, centre));
    return least;
}

struct Contour {
    std::vector<glm::dvec2> points;
    double widest_gap = 0.0;      ///< Radians.
    double retained_share = 0.0;  ///< Of the points.
};

// Indices of rays with a retained hit, in ray order.
std::vector<std::size_t> retained_rays(const RayPolygon& polygon) {
    std::vector<std::size_t> rays;
    for (std::size_t l = 0; l < polygon.rays.size(); ++l)
        if (polygon.rays[l] == Ray::Retained)
            rays.push_back(l);
    return rays;
}

bool gap_follows(const RayPolygon& polygon, std::size_t from, std::size_t to) {
    for (std::size_t l = (from + 1) % polygon.rays.size(); l != to;
         l = (l + 1) % polygon.rays.size())
        if (polygon.rays[l] == Ray::Outlier || polygon.rays[l] == Ray::Missing)
            return true;
    return false;
}

// A.9: retained vertices, and points of a curve wherever rays between two of them were deleted.
Contour completed(const RayPolygon& polygon, glm::dvec2 centre, const ThesisOptions& options) {
    const std::vector<std::size_t> rays = retained_rays(polygon);
    const std::size_t n = rays.size();
    const auto vertex = [&](std::size_t i) { return polygon.hits[rays[i % n]]; };
    Contour contour;
    for (std::size_t i = 0; i < n; ++i) {
        contour.points.push_back(vertex(i));
        if (!gap_follows(polygon, rays[i], rays[(i + 1) % n]))
            continue;
        const ContourGap gap{vertex(i + n - 1), vertex(i), vertex(i + 1), vertex(i + 2)};
        contour.widest_gap = std::max(contour.widest_gap, gap_angle(gap, centre));
        for (const glm::dvec2 p : gap_points(gap, centre, options))
            contour.points.push_back(p);
    }
    contour.retained_share = static_cast<double>(n) / static_cast<double>(contour.points.size());
    return contour;
}

double share_of_rays_kept(const RayPolygon& polygon) {
    const auto n = std::count_if(polygon.rays.begin(), polygon.rays.end(), [](Ray ray) {
        return ray == Ray::Retained || ray == Ray::Repeated;
    });
    return static_cast<double>(n) / static_cast<double>(polygon.rays.size());
}

bool leaves_picture(const Outline& outline, const RayCaster& caster) {
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 p = border_point(outline, k);
        if (p.x < 1.0 || p.y < 1.0 || p.x > caster.width() - 1 || p.y > caster.height() - 1)
            return true;
    }
    return false;
}

void inset_radii(std::array<float, kRadii>& radii, double inset) {
    const auto by = static_cast<float>(inset);
    for (float& r : radii)
        r = std::max(0.5F * r, r - by);
}

// Filter the hits of rays first, first + stride, ...; false if too few of them are left.
bool filter_set(RayPolygon& polygon, std::size_t first, std::size_t stride,
                const ThesisOptions& options) {
    std::vector<glm::dvec2> vertices;
    std::vector<std::size_t> vertex_of;  // per hit of the set, in ray order
    std::vector<std::size_t> ray_of;
    for (std::size_t l = first; l < polygon.rays.size(); l += stride) {
        if (polygon.rays[l] == Ray::Missing)
            continue;
        if (vertices.empty() || vertices.back() != polygon.hits[l])
            vertices.push_back(polygon.hits[l]);
        vertex_of.push_back(vertices.size() - 1);
        ray_of.push_back(l);
    }
    const bool closed = vertices.size() > 1 && vertices.back() == vertices.front();
    if (closed)
        vertices.pop_back();
    const FilteredPolygon filtered = filter_outliers(vertices, options);
    for (std::size_t i = 0; i < ray_of.size(); ++i)
        if (filtered.kept[vertex_of[i] % vertices.size()] == 0)
            polygon.rays[ray_of[i]] = Ray::Outlier;
    if (filtered.accepted)
        polygon.severity = std::min(polygon.severity, filtered.severity);
    return filtered.accepted;
}

// Coincident hits make one vertex: the first of them in ray order.
void drop_repeated(RayPolygon& polygon) {
    for (std::size_t l = 0; l < polygon.rays.size(); ++l) {
        if (polygon.rays[l] != Ray::Retained)
            continue;
        const glm::dvec2 p = polygon.hits[l];
        const bool repeated = !polygon.retained.empty() &&
                              (polygon.retained.back() == p || polygon.retained.front() == p);
        if (repeated)
            polygon.rays[l] = Ray::Repeated;
        else
            polygon.retained.push_back(p);
    }
}

}  // namespace

SliceTracer::SliceTracer(const Mask& edges, const ThesisOptions& options)
    : options_(options),
      caster_(edges),
      directions_(ray_directions(options.rays)),
      final_directions_(ray_directions(options.final_rays)) {
    check_thesis(options);
}

std::optional<RayPolygon> SliceTracer::cast_and_filter(glm::dvec2 centre, bool last_pass) const {
    const auto& directions = last_pass ? final_directions_ : directions_;
    RayPolygon polygon;
    polygon.rays.resize(directions.size(), Ray::Missing);
    polygon.hits.resize(directions.size());
    for (std::size_t l = 0; l < directions.size(); ++l)
        if (const auto hit = caster_.cast(centre, directions[l])) {
            polygon.hits[l] = glm::dvec2(hit->pixel) + 0.5;
            polygon.rays[l] = Ray::Retained;
        }
    // The factors of (3.8) suit the spacing of `rays` hits: denser ones turn by less and would let
    // escapes pass. So a denser last pass is filtered in interleaved sets of that spacing.
    const std::size_t n_sets = std::max<std::size_t>(1, directions.size() / directions_.size());
    bool accepted = false;
    polygon.severity = 1.0;
    for (std::size_t first = 0; first < n_sets; ++first)
        if (filter_set(polygon, first, n_sets, options_))
            accepted = true;
    if (!accepted)
        return std::nullopt;
    drop_repeated(polygon);
    return polygon;
}

std::optional<SliceTracer::Centre> SliceTracer::settle(glm::dvec2 sample) const {
    struct Iterate {
        glm::dvec2 point;
        double least_radius;
    };
    std::vector<Iterate> history;
    glm::dvec2 centre = sample;
    for (int iteration = 1; iteration <= options_.centroid_iterations; ++iteration) {
        const auto polygon = cast_and_filter(centre, false);
        if (!polygon)
            return std::nullopt;
        history.push_back({centre, least_distance(polygon->retained, centre)});
        const glm::dvec2 next = options_.centroid == CentroidKind::Area
                                    ? area_centroid(polygon->retained)
                                    : vertex_mean(polygon->retained);
        if (!caster_.is_open(next) || !is_inside(polygon->retained, next))
            return std::nullopt;
        if (glm::distance(next, centre) < options_.centroid_tolerance)
            return Centre{next, iteration};
        const bool seen = std::any_of(history.begin(), history.end(), [&](const Iterate& i) {
            return glm::distance(i.point, next) < 1e-9;
        });
        if (seen)
            break;
        centre = next;
    }
    // It swings: take the iterate that sits deepest (A.8).
    const auto deepest = std::max_element(
        history.begin(), history.end(),
        [](const Iterate& a, const Iterate& b) { return a.least_radius < b.least_radius; });
    return Centre{deepest->point, static_cast<int>(history.size())};
}

std::optional<Slice> SliceTracer::trace(glm::dvec2 sample) const {
    if (!caster_.is_open(sample))
        return std::nullopt;
    const auto centre = settle(sample);
    if (!centre)
        return std::nullopt;
    auto slice = finish(*centre);
    if (!slice || !passes_quality(*slice))
        return std::nullopt;
    return slice;
}

std::optional<Slice> SliceTracer::finish(const Centre& centre) const {
    const auto polygon = cast_and_filter(centre.point, true);
    if (!polygon)
        return std::nullopt;
    Contour contour = completed(*polygon, centre.point, options_);
    if (contour.widest_gap > options_.greatest_gap * std::numbers::pi / 180.0)
        return std::nullopt;
    auto radii = polygon_radii(contour.points, centre.point);
    if (!radii)
        return std::nullopt;
    inset_radii(*radii, options_.inset);
    Slice slice;
    slice.outline.centre = centre.point;
    slice.outline.radii = *radii;
    slice.outline.confidence = static_cast<float>(share_of_rays_kept(*polygon));
    slice.outline.touches_border = leaves_picture(slice.outline, caster_);
    for (const Ray ray : polygon->rays)
        slice.outline.touches_border = slice.outline.touches_border || ray == Ray::Missing;
    slice.depth = options_.depth_from == DepthFrom::FinalRadii
                      ? *std::min_element(radii->begin(), radii->end())
                      : static_cast<float>(least_distance(polygon->retained, centre.point));
    slice.contour = std::move(contour.points);
    slice.retained_share = contour.retained_share;
    slice.severity = polygon->severity;
    slice.n_iterations = centre.n_iterations;
    return slice;
}

bool SliceTracer::passes_quality(const Slice& slice) const {
    const auto& radii = slice.outline.radii;
    const double greatest = *std::max_element(radii.begin(), radii.end());
    return outline_area(slice.outline) >= options_.least_area &&
           greatest <= options_.greatest_radius * caster_.width() &&
           slice.retained_share >= options_.least_retained_share;
}

}  // namespace scree::vision
