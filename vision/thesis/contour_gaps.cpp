#include "vision/thesis/contour_gaps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scree::vision {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLeastRadiusShare = 0.5;
constexpr double kGreatestRadiusShare = 1.5;

glm::dvec2 unit_or_zero(glm::dvec2 v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec2(0.0);
}

glm::dvec2 on_curve(const std::array<glm::dvec2, 4>& p, double t) {
    const double s = 1.0 - t;
    return s * s * s * p[0] + 3.0 * s * s * t * p[1] + 3.0 * s * t * t * p[2] + t * t * t * p[3];
}

// Azimuth of `p` measured onwards from that of `from`, in [0, 2 pi).
double azimuth_onwards(glm::dvec2 from, glm::dvec2 p) {
    const double angle = std::atan2(from.x * p.y - from.y * p.x, glm::dot(from, p));
    return angle < 0.0 ? angle + kTurn : angle;
}

std::vector<glm::dvec2> guarded(std::vector<glm::dvec2> points, const ContourGap& gap,
                                glm::dvec2 centre) {
    const glm::dvec2 from = gap.last - centre;
    const double r0 = glm::length(from);
    const double r1 = glm::length(gap.first - centre);
    const double whole = gap_angle(gap, centre);
    bool increasing = true;
    double reached = 0.0;
    for (const glm::dvec2 p : points) {
        const double azimuth = azimuth_onwards(from, p - centre);
        increasing = increasing && azimuth > reached && azimuth < whole;
        reached = azimuth;
    }
    const double n = static_cast<double>(points.size() + 1);
    for (std::size_t m = 0; m < points.size(); ++m) {
        const double even = static_cast<double>(m + 1) / n * whole;
        const double azimuth = increasing ? azimuth_onwards(from, points[m] - centre) : even;
        const double share = whole > 0.0 ? azimuth / whole : 0.0;
        const double expected = r0 + share * (r1 - r0);
        const double r =
            increasing ? std::clamp(glm::length(points[m] - centre), kLeastRadiusShare * expected,
                                    kGreatestRadiusShare * expected)
                       : expected;
        const double angle = std::atan2(from.y, from.x) + azimuth;
        points[m] = centre + r * glm::dvec2(std::cos(angle), std::sin(angle));
    }
    return points;
}

}  // namespace

std::array<glm::dvec2, 4> gap_curve(const ContourGap& gap) {
    const double handle = glm::length(gap.first - gap.last) / 3.0;
    const glm::dvec2 leaving = unit_or_zero(gap.last - gap.before_last);
    const glm::dvec2 arriving = unit_or_zero(gap.after_first - gap.first);
    return {gap.last, gap.last + handle * leaving, gap.first - handle * arriving, gap.first};
}

double gap_angle(const ContourGap& gap, glm::dvec2 centre) {
    return azimuth_onwards(gap.last - centre, gap.first - centre);
}

std::vector<glm::dvec2> gap_points(const ContourGap& gap, glm::dvec2 centre,
                                   const ThesisOptions& options) {
    std::vector<glm::dvec2> points;
    if (options.gap_fill == GapFill::Chord)
        return points;
    const auto curve = gap_curve(gap);
    for (int m = 1; m <= options.bezier_points; ++m)
        points.push_back(on_curve(curve, static_cast<double>(m) / (options.bezier_points + 1)));
    return options.gap_fill == GapFill::GuardedBezier ? guarded(std::move(points), gap, centre)
                                                      : points;
}

}  // namespace scree::vision
