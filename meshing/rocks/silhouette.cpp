#include "meshing/rocks/silhouette.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kCorners = kSilhouetteCorners;
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStep = kTurn / kCorners;

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// A point in polar form; the azimuth in corners, 0 to 64.
struct Polar {
    glm::dvec2 point;
    double azimuth;
    double distance;
};

Polar polar_of(const glm::vec3& p) {
    const double azimuth = std::atan2(static_cast<double>(p.z), static_cast<double>(p.x));
    const glm::dvec2 point(p.x, p.z);
    return {point, (azimuth < 0.0 ? azimuth + kTurn : azimuth) / kStep, glm::length(point)};
}

// Farthest reach of the mesh in each of the 64 sectors between corners. The reach along an edge is
// greatest at one of its ends, or where the edge enters or leaves the sector.
class Sectors {
public:
    void add_edge(const Polar& a, const Polar& b) {
        double to = b.azimuth;
        if (to - a.azimuth > 0.5 * kCorners)
            to -= kCorners;
        if (a.azimuth - to > 0.5 * kCorners)
            to += kCorners;
        add_point(a.azimuth, a.distance);
        const double high = std::max(a.azimuth, to);
        for (double border = std::ceil(std::min(a.azimuth, to)); border < high; border += 1.0) {
            const glm::dvec2 ray(std::cos(border * kStep), std::sin(border * kStep));
            const glm::dvec2 edge = b.point - a.point;
            const double across = edge.x * ray.y - edge.y * ray.x;
            if (across == 0.0)
                continue;  // both ends lie on the ray
            const double t = std::clamp((ray.x * a.point.y - ray.y * a.point.x) / across, 0.0, 1.0);
            const double reach = glm::length(a.point + t * edge);
            add_point(border - 0.5, reach);
            add_point(border + 0.5, reach);
        }
    }

    double reach(std::size_t sector) const { return reach_[sector % kCorners]; }

private:
    void add_point(double position, double distance) {
        const auto sector = static_cast<long>(std::floor(position));
        constexpr auto kN = static_cast<long>(kCorners);
        double& most = reach_[static_cast<std::size_t>(((sector % kN) + kN) % kN)];
        most = std::max(most, distance);
    }

    std::array<double, kCorners> reach_{};
};

struct Interval {
    glm::vec2 low;
    glm::vec2 high;
};

// Edges of a polygon that come near a box, as pairs of points.
struct Edges {
    std::array<glm::vec2, kCorners + 1> from;  // one to write on before it counts
    std::array<glm::vec2, kCorners + 1> to;
    std::size_t n = 0;
};

Edges edges_near(const Silhouette& s, glm::vec2 offset, const Interval& box) {
    Edges edges;
    glm::vec2 a = s.corners[kCorners - 1] + offset;
    for (const glm::vec2 corner : s.corners) {
        const glm::vec2 b = corner + offset;
        const bool apart = std::max(a.x, b.x) < box.low.x || std::min(a.x, b.x) > box.high.x ||
                           std::max(a.y, b.y) < box.low.y || std::min(a.y, b.y) > box.high.y;
        edges.from[edges.n] = a;
        edges.to[edges.n] = b;
        edges.n += apart ? 0U : 1U;
        a = b;
    }
    return edges;
}

bool cross_each_other(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
    const float c_side = cross(b - a, c - a);
    const float d_side = cross(b - a, d - a);
    const float a_side = cross(d - c, a - c);
    const float b_side = cross(d - c, b - c);
    return c_side * d_side <= 0.0F && a_side * b_side <= 0.0F;
}

bool holds(const Silhouette& s, glm::vec2 point) {
    bool inside = false;
    glm::vec2 a = s.corners[kCorners - 1];
    for (const glm::vec2 b : s.corners) {
        if ((a.y <= point.y) != (b.y <= point.y)) {
            const bool left = (point.x - a.x) * (b.y - a.y) < (point.y - a.y) * (b.x - a.x);
            inside ^= left == (b.y > a.y);
        }
        a = b;
    }
    return inside;
}

Interval box_of(const Silhouette& s, glm::vec2 offset) {
    Interval box{s.corners[0], s.corners[0]};
    for (const glm::vec2 corner : s.corners) {
        box.low = glm::min(box.low, corner);
        box.high = glm::max(box.high, corner);
    }
    return {box.low + offset, box.high + offset};
}

}  // namespace

Silhouette silhouette_of(const TriMesh& mesh) {
    check_mesh(mesh);
    std::vector<Polar> polar;
    polar.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        polar.push_back(polar_of(p));
    Sectors sectors;
    for (const glm::uvec3& t : mesh.triangles) {
        sectors.add_edge(polar[t.x], polar[t.y]);
        sectors.add_edge(polar[t.y], polar[t.z]);
        sectors.add_edge(polar[t.z], polar[t.x]);
    }
    Silhouette silhouette;
    const double outside = 1.0 / std::cos(0.5 * kStep);  // a chord bends inwards by this much
    for (std::size_t k = 0; k < kCorners; ++k) {
        const double reach = outside * std::max(sectors.reach(k), sectors.reach(k + kCorners - 1));
        if (!(reach > 0.0))
            fail<InvalidInput>(
                "the mesh covers no ground about its origin; its silhouette is empty");
        const double azimuth = static_cast<double>(k) * kStep;
        silhouette.corners[k] = reach * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
        silhouette.radius = std::max(silhouette.radius, static_cast<float>(reach));
    }
    return silhouette;
}

Silhouette placed(const Silhouette& silhouette, double scale, double yaw) {
    Silhouette result;
    result.radius = static_cast<float>(scale * static_cast<double>(silhouette.radius));
    const auto c = static_cast<float>(scale * std::cos(yaw));
    const auto s = static_cast<float>(scale * std::sin(yaw));
    for (std::size_t k = 0; k < kCorners; ++k) {
        const glm::vec2 p = silhouette.corners[k];
        result.corners[k] = {c * p.x + s * p.y, c * p.y - s * p.x};
    }
    return result;
}

double area_of(const Silhouette& silhouette) {
    double twice = 0.0;
    for (std::size_t k = 0; k < kCorners; ++k)
        twice += static_cast<double>(
            cross(silhouette.corners[k], silhouette.corners[(k + 1) % kCorners]));
    return 0.5 * twice;
}

bool overlap(const Silhouette& first, const Silhouette& second, glm::vec2 offset) {
    const float reach = first.radius + second.radius;
    const float distance = glm::dot(offset, offset);
    if (distance > reach * reach)
        return false;
    const Edges a = edges_near(first, glm::vec2(0.0F), box_of(second, offset));
    const Edges b = edges_near(second, offset, box_of(first, glm::vec2(0.0F)));
    for (std::size_t i = 0; i < a.n; ++i)
        for (std::size_t j = 0; j < b.n; ++j)
            if (cross_each_other(a.from[i], a.to[i], b.from[j], b.to[j]))
                return true;
    // No edges cross: apart, or one lies inside the other.
    const float larger = std::max(first.radius, second.radius);
    return distance <= larger * larger && (holds(first, offset) || holds(second, -offset));
}

}  // namespace scree::meshing
