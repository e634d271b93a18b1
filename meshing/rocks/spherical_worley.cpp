#include "meshing/rocks/spherical_worley.h"

#include "base/error.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSlack = 1e-7;  // radians; more than arccos loses near a point
constexpr std::uint64_t kStream = 0x3071e7;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

void take(WorleyDistances& nearest, double distance) {
    if (distance < nearest.first)
        nearest = {distance, nearest.first, nearest.second};
    else if (distance < nearest.second)
        nearest = {nearest.first, distance, nearest.second};
    else if (distance < nearest.third)
        nearest.third = distance;
}

constexpr WorleyDistances kFarthest{2.0 * kPi, 2.0 * kPi, 2.0 * kPi};

}  // namespace

std::vector<glm::dvec3> scatter_on_sphere(int n, std::uint64_t seed) {
    if (n < 3 || n > 1'000'000)
        fail<InvalidOption>("points is ", n, ", must be in [3, 1000000]");
    const double golden = kPi * (3.0 - std::sqrt(5.0));
    const double spacing = std::sqrt(4.0 * kPi / n);  // of n points on the sphere
    std::vector<glm::dvec3> points;
    points.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        Rng rng({.seed = seed, .stream = kStream, .cell = static_cast<std::uint64_t>(i)});
        const double y = -1.0 + 2.0 * (i + rng.uniform()) / n;  // bands of equal area
        const double out = std::sqrt(std::max(0.0, 1.0 - y * y));
        const double sway = spacing / std::max(out, 0.5 * spacing);
        const double azimuth = golden * i + sway * rng.uniform(-0.5, 0.5);
        points.emplace_back(out * std::cos(azimuth), y, out * std::sin(azimuth));
    }
    return points;
}

SphericalWorley::SphericalWorley(int n_points, std::uint64_t seed)
    : points_(scatter_on_sphere(n_points, seed)) {
    elevations_.reserve(points_.size());
    for (const glm::dvec3& p : points_)
        elevations_.push_back(std::asin(std::clamp(p.y, -1.0, 1.0)));
}

WorleyDistances SphericalWorley::distances(const glm::dvec3& direction) const {
    const double elevation = std::asin(std::clamp(direction.y, -1.0, 1.0));
    const auto middle = std::lower_bound(elevations_.begin(), elevations_.end(), elevation);
    WorleyDistances nearest = kFarthest;
    auto up = static_cast<std::size_t>(middle - elevations_.begin());
    std::size_t down = up;
    bool more = true;
    while (more) {  // two points are at least as far apart as their elevations
        more = false;
        if (up < points_.size() && elevations_[up] - elevation <= nearest.third + kSlack) {
            take(nearest, angle_between(direction, points_[up++]));
            more = true;
        }
        if (down > 0 && elevation - elevations_[down - 1] <= nearest.third + kSlack) {
            take(nearest, angle_between(direction, points_[--down]));
            more = true;
        }
    }
    return nearest;
}

WorleyDistances SphericalWorley::distances_by_search(const glm::dvec3& direction) const {
    WorleyDistances nearest = kFarthest;
    for (const glm::dvec3& point : points_)
        take(nearest, angle_between(direction, point));
    return nearest;
}

}  // namespace scree::meshing
