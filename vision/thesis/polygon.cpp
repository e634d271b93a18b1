#include "vision/thesis/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace scree::vision {
namespace {

constexpr double kLeastRadius = 1e-3;  // outlines need positive radii

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

std::array<glm::dvec2, kRadii> degree_directions() {
    std::array<glm::dvec2, kRadii> directions{};
    for (std::size_t k = 0; k < kRadii; ++k) {
        const double azimuth = std::numbers::pi / 180.0 * static_cast<double>(k);
        directions[k] = {std::cos(azimuth), std::sin(azimuth)};
    }
    return directions;
}

// Lower the radii at the whole degrees between the ends of one edge, given from the centre.
void cut_rays(glm::dvec2 a, glm::dvec2 b, const std::array<glm::dvec2, kRadii>& directions,
              std::array<double, kRadii>& radii) {
    const double to_degree = 180.0 / std::numbers::pi;
    if (cross(a, b) < 0.0)
        std::swap(a, b);
    const double from = std::atan2(a.y, a.x) * to_degree;
    double to = std::atan2(b.y, b.x) * to_degree;
    if (to < from)
        to += 360.0;
    // One degree of slack on either side: the exact test decides.
    for (int k = static_cast<int>(std::floor(from)); k <= static_cast<int>(std::ceil(to)); ++k) {
        const auto slot = static_cast<std::size_t>(((k % kRadii) + kRadii) % kRadii);
        const glm::dvec2 d = directions[slot];
        const double before = cross(a, d);
        const double after = cross(d, b);
        constexpr double kSlack = 1e-9;
        if (before < -kSlack || after < -kSlack ||
            a.x * d.x + a.y * d.y + b.x * d.x + b.y * d.y < 0)
            continue;
        const double along = cross(d, b - a);
        const double t = std::abs(along) > 1e-12
                             ? cross(a, b - a) / along
                             : std::min(std::hypot(a.x, a.y), std::hypot(b.x, b.y));
        if (t > 0.0)
            radii[slot] = std::min(radii[slot], t);
    }
}

}  // namespace

double signed_area(std::span<const glm::dvec2> polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5 * twice;
}

glm::dvec2 vertex_mean(std::span<const glm::dvec2> polygon) {
    glm::dvec2 sum{0.0};
    for (const glm::dvec2 p : polygon)
        sum += p;
    return sum / static_cast<double>(polygon.size());
}

glm::dvec2 area_centroid(std::span<const glm::dvec2> polygon) {
    const glm::dvec2 origin = polygon.front();
    double twice = 0.0;
    glm::dvec2 sum{0.0};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - origin;
        const glm::dvec2 b = polygon[(i + 1) % polygon.size()] - origin;
        twice += cross(a, b);
        sum += cross(a, b) * (a + b);
    }
    return std::abs(twice) < 1e-9 ? vertex_mean(polygon) : origin + sum / (3.0 * twice);
}

bool is_inside(std::span<const glm::dvec2> polygon, glm::dvec2 point) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i];
        const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
        if ((a.y <= point.y) != (b.y <= point.y) &&
            point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

void for_each_inside_run(std::span<const glm::dvec2> polygon, int width, int height,
                         const std::function<void(int y, int from, int to)>& visit) {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const glm::dvec2 p : polygon) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    const int first = static_cast<int>(std::floor(std::clamp(low, 0.0, 1.0 * height)));
    const int last = static_cast<int>(std::ceil(std::clamp(high, 0.0, 1.0 * height)));
    std::vector<double> crossings;
    for (int y = first; y < last; ++y) {
        const double level = y + 0.5;
        crossings.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 a = polygon[i];
            const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
            if ((a.y <= level) != (b.y <= level))
                crossings.push_back(a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x));
        }
        std::sort(crossings.begin(), crossings.end());
        const auto column = [width](double x) {
            return static_cast<int>(std::ceil(std::clamp(x - 0.5, 0.0, 1.0 * width)));
        };
        for (std::size_t c = 0; c + 1 < crossings.size(); c += 2) {
            const int from = column(crossings[c]);
            const int to = column(crossings[c + 1]);
            if (from < to)
                visit(y, from, to);
        }
    }
}

std::optional<std::array<float, kRadii>> polygon_radii(std::span<const glm::dvec2> polygon,
                                                       glm::dvec2 centre) {
    static const std::array<glm::dvec2, kRadii> directions = degree_directions();
    constexpr double kMissed = std::numeric_limits<double>::max();
    std::array<double, kRadii> nearest;
    nearest.fill(kMissed);
    for (std::size_t i = 0; i < polygon.size(); ++i)
        cut_rays(polygon[i] - centre, polygon[(i + 1) % polygon.size()] - centre, directions,
                 nearest);
    std::array<float, kRadii> radii{};
    for (std::size_t k = 0; k < kRadii; ++k) {
        if (nearest[k] == kMissed)
            return std::nullopt;
        radii[k] = static_cast<float>(std::max(kLeastRadius, nearest[k]));
    }
    return radii;
}

}  // namespace scree::vision
