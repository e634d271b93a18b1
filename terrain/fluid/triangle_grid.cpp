#include "terrain/fluid/triangle_grid.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <glm/vector_relational.hpp>

namespace scree::terrain {
namespace {

constexpr std::size_t kGrain = 2048;
constexpr std::size_t kMostCells = 1U << 24;
constexpr float kSameWay = 0.94F;  // planes within 20 degrees are one

struct Feature {
    glm::vec3 point;
    bool inside = false;  // of the face, not on its rim
};

// Closest point of a triangle, by the region of its plane that the point lies over.
Feature closest_point(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                      const glm::vec3& p) {
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0F && d2 <= 0.0F)
        return {a};
    const glm::vec3 bp = p - b;
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0F && d4 <= d3)
        return {b};
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F && d1 > d3)
        return {a + ab * (d1 / (d1 - d3))};
    const glm::vec3 cp = p - c;
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0F && d5 <= d6)
        return {c};
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F && d2 > d6)
        return {a + ac * (d2 / (d2 - d6))};
    const float va = d3 * d6 - d5 * d4;
    const float along = d4 - d3, back = d5 - d6;
    if (va <= 0.0F && along >= 0.0F && back >= 0.0F && along + back > 0.0F)
        return {b + (c - b) * (along / (along + back))};
    const float sum = va + vb + vc;
    if (!(sum > 0.0F))
        return {a};
    return {a + ab * (vb / sum) + ac * (vc / sum), true};
}

double side_of_edge(const glm::dvec3& direction, const glm::dvec3& p, const glm::dvec3& q) {
    return glm::dot(direction, glm::cross(p, q));
}

// Share of the segment at which it passes through the triangle from front to back, or 2. Edges
// belong to both of their triangles, so nothing slips through between them.
// A start up to `slack_height` behind the front counts as one upon it.
double front_crossing(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3* corner,
                      double slack_height) {
    const glm::dvec3 way = to - from;
    const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double against = glm::dot(way, normal);
    if (!(against < 0.0))
        return 2.0;
    const double height = glm::dot(from - corner[0], normal);
    if (height < -slack_height * glm::length(normal) || height > -against)
        return 2.0;
    const glm::dvec3 a = corner[0] - from, b = corner[1] - from, c = corner[2] - from;
    const double u = side_of_edge(way, b, c);
    const double v = side_of_edge(way, c, a);
    const double w = side_of_edge(way, a, b);
    const double slack = 1e-9 * (std::abs(u) + std::abs(v) + std::abs(w));
    const bool through = (u <= slack && v <= slack && w <= slack);
    return through ? std::max(0.0, height / -against) : 2.0;
}

// The nearest of some hits; see TriangleGrid::nearest().
struct NearestOf {
    explicit NearestOf(float most) : reach(most), best_length(most) {}

    void offer(const SurfaceHit& hit, const glm::vec3& point, const glm::vec3& face) {
        const float length = std::abs(hit.distance);
        const float height = std::abs(glm::dot(point - hit.point, face));
        // Distances that differ by rounding alone are those of one shared edge or corner.
        const float tie = 1e-5F * reach;
        const bool nearer = length < best_length - tie;
        const bool equal = length <= std::min(reach, best_length + tie);
        if (nearer || (equal && height > best_height)) {
            best = hit;
            best_length = std::min(best_length, length);
            best_height = height;
        }
    }

    float reach;
    float best_length;
    float best_height = -1.0F;
    SurfaceHit best;
};

}  // namespace

TriangleGrid::TriangleGrid(const meshing::TriMesh& mesh, float cell) {
    meshing::check_mesh(mesh);
    const std::size_t n = mesh.triangles.size();
    if (n == 0)
        fail<InvalidInput>("a mesh to collide with has no triangle");
    corners_.resize(3 * n);
    normals_.resize(n);
    low_ = high_ = mesh.positions[mesh.triangles[0].x];
    double edges = 0.0;
    for (std::size_t t = 0; t < n; ++t) {
        const glm::uvec3& f = mesh.triangles[t];
        glm::vec3* c = &corners_[3 * t];
        c[0] = mesh.positions[f.x];
        c[1] = mesh.positions[f.y];
        c[2] = mesh.positions[f.z];
        low_ = glm::min(low_, glm::min(c[0], glm::min(c[1], c[2])));
        high_ = glm::max(high_, glm::max(c[0], glm::max(c[1], c[2])));
        edges += static_cast<double>(glm::length(c[1] - c[0]));
    }
    const auto mean_edge = static_cast<float>(edges / static_cast<double>(n));
    grid_ = make_cell_grid(low_, high_, std::max(cell, mean_edge),
                           std::min(kMostCells, 65536 + 16 * n));
    fill_cells();
}

void TriangleGrid::fill_cells() {
    const std::size_t n = n_triangles();
    balls_.resize(n);
    firsts_.resize(n);
    lasts_.resize(n);
    parallel_for_each_index(0, n, kGrain, [&](std::size_t t) {
        const glm::vec3* c = &corners_[3 * t];
        firsts_[t] = grid_.cell_of(glm::min(c[0], glm::min(c[1], c[2])));
        lasts_[t] = grid_.cell_of(glm::max(c[0], glm::max(c[1], c[2])));
        const glm::vec3 centre = (c[0] + c[1] + c[2]) / 3.0F;
        const float radius = std::max({glm::distance(centre, c[0]), glm::distance(centre, c[1]),
                                       glm::distance(centre, c[2])});
        balls_[t] = {centre, 1.0001F * radius};
        const glm::vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
        const float length = glm::length(normal);
        normals_[t] = length > 0.0F ? normal / length : glm::vec3(0.0F);
    });
    const auto each_cell = [&](std::size_t t, auto&& visit) {
        const glm::ivec3 lo = firsts_[t], hi = lasts_[t];
        for (int z = lo.z; z <= hi.z; ++z)
            for (int y = lo.y; y <= hi.y; ++y)
                for (int x = lo.x; x <= hi.x; ++x)
                    visit(grid_.index(x, y, z));
    };
    starts_.assign(grid_.n_cells() + 1, 0);
    std::size_t total = 0;
    for (std::size_t t = 0; t < n; ++t)
        each_cell(t, [&](std::size_t cell) {
            ++starts_[cell];
            ++total;
        });
    if (total > std::numeric_limits<std::uint32_t>::max() / 2)
        fail<InvalidInput>("a mesh to collide with has ", n,
                           " triangles so unequal that its search grid would need ", total,
                           " entries; divide the largest triangles");
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts_) {
        sum += start;
        start = sum;
    }
    items_.resize(total);
    for (std::size_t t = n; t-- > 0;)
        each_cell(
            t, [&](std::size_t cell) { items_[--starts_[cell]] = static_cast<std::uint32_t>(t); });
}

// Every triangle whose box may overlap the box low..high, each once: in the first cell that the two
// have in common.
template <class Visit>
void TriangleGrid::triangles_in(const glm::vec3& low, const glm::vec3& high, Visit&& visit) const {
    if (items_.empty() || glm::any(glm::greaterThan(low, high_)) ||
        glm::any(glm::lessThan(high, low_)))
        return;
    const glm::ivec3 first = grid_.cell_of(low);
    const glm::ivec3 last = grid_.cell_of(high);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const std::size_t cell = grid_.index(x, y, z);
                for (std::uint32_t k = starts_[cell]; k < starts_[cell + 1]; ++k) {
                    const std::uint32_t t = items_[k];
                    const glm::ivec3 common = glm::max(first, firsts_[t]);
                    if (common.x == x && common.y == y && common.z == z)
                        visit(t);
                }
            }
}

SurfaceHit TriangleGrid::closest_on(std::uint32_t triangle, const glm::vec3& point) const {
    const glm::vec3* c = &corners_[3 * static_cast<std::size_t>(triangle)];
    const Feature at = closest_point(c[0], c[1], c[2], point);
    const glm::vec3& face = normals_[triangle];
    const glm::vec3 away = point - at.point;
    const float height = glm::dot(away, face);
    SurfaceHit hit{triangle, at.point, face, 0.0F};
    if (at.inside) {
        hit.distance = height;
        return hit;
    }
    const float length = glm::length(away);
    const float side = height < 0.0F ? -1.0F : 1.0F;
    hit.distance = side * length;
    if (length > 0.0F)
        hit.normal = away * (side / length);
    return hit;
}

bool TriangleGrid::out_of_reach(std::uint32_t triangle, const glm::vec3& point, float reach) const {
    const Ball& ball = balls_[triangle];
    const glm::vec3 d = point - ball.centre;
    const float most = reach + ball.radius;
    return glm::dot(d, d) > most * most;
}

SurfaceHit TriangleGrid::nearest(const glm::vec3& point, float reach) const {
    NearestOf chosen(reach);
    triangles_in(point - reach, point + reach, [&](std::uint32_t t) {
        if (!out_of_reach(t, point, reach))
            chosen.offer(closest_on(t, point), point, normals_[t]);
    });
    return chosen.best;
}

ContactPlanes TriangleGrid::contacts(const glm::vec3& point, float reach) const {
    thread_local std::vector<SurfaceHit> hits;
    hits.clear();
    NearestOf chosen(reach);
    triangles_in(point - reach, point + reach, [&](std::uint32_t t) {
        if (out_of_reach(t, point, reach))
            return;
        const SurfaceHit hit = closest_on(t, point);
        chosen.offer(hit, point, normals_[t]);
        // A face counts where the point lies over it; seen past its rim, a neighbour is nearer.
        if (std::abs(hit.distance) <= reach && glm::dot(hit.normal, normals_[t]) >= kSameWay)
            hits.push_back(hit);
    });
    ContactPlanes found;
    const SurfaceHit& first = chosen.best;
    if (!first.found())
        return found;
    // In front of the nearest face, one seen from behind belongs to the far side of a thin wall.
    const float least = first.distance < 0.0F ? -reach : -0.05F * reach;
    found.planes[found.count++] = {first.triangle, first.point, first.normal};
    float lengths[3] = {std::abs(first.distance), 0.0F, 0.0F};
    for (const SurfaceHit& hit : hits) {
        if (hit.distance < least)
            continue;
        int same = 0;
        while (same < found.count && glm::dot(found.planes[same].normal, hit.normal) <= kSameWay)
            ++same;
        const float length = std::abs(hit.distance);
        if (same == 3 || (same < found.count && (same == 0 || length >= lengths[same])))
            continue;
        lengths[same] = length;
        found.planes[same] = {hit.triangle, hit.point, hit.normal};
        found.count = std::max(found.count, same + 1);
    }
    return found;
}

float TriangleGrid::free_share(const glm::vec3& from, const glm::vec3& to) const {
    const double slack = 1e-5 / static_cast<double>(grid_.per_metre);
    double first = 1.0;
    bool hit = false;
    triangles_in(glm::min(from, to), glm::max(from, to), [&](std::uint32_t t) {
        const glm::vec3* c = &corners_[3 * static_cast<std::size_t>(t)];
        const glm::dvec3 corner[3] = {glm::dvec3(c[0]), glm::dvec3(c[1]), glm::dvec3(c[2])};
        const double share = front_crossing(glm::dvec3(from), glm::dvec3(to), corner, slack);
        if (share <= first) {
            first = share;
            hit = true;
        }
    });
    return hit ? static_cast<float>(first) : 1.0F;
}

bool TriangleGrid::buried(const glm::vec3& point) const {
    // Moved a little aside, so that the line does not run along the edges of a regular mesh.
    const float aside = 1e-3F / grid_.per_metre;
    const glm::vec3 from = point + glm::vec3(0.7F * aside, 0.0F, 0.4F * aside);
    const glm::vec3 top(from.x, std::max(from.y, high_.y) + 1.0F / grid_.per_metre, from.z);
    int leaving = 0;
    triangles_in(from, top, [&](std::uint32_t t) {
        const glm::vec3* c = &corners_[3 * static_cast<std::size_t>(t)];
        const glm::dvec3 corner[3] = {glm::dvec3(c[0]), glm::dvec3(c[1]), glm::dvec3(c[2])};
        const glm::dvec3 other[3] = {corner[0], corner[2], corner[1]};
        leaving -= front_crossing(glm::dvec3(from), glm::dvec3(top), corner, 0.0) <= 1.0 ? 1 : 0;
        leaving += front_crossing(glm::dvec3(from), glm::dvec3(top), other, 0.0) <= 1.0 ? 1 : 0;
    });
    return leaving > 0;
}

}  // namespace scree::terrain
