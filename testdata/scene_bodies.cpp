#include "testdata/scene_bodies.h"

#include "base/random.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace scree::test {
namespace {

constexpr std::uint64_t kRockStream = 31;

// The smaller of two, rounded where they are nearly equal.
double soft_min(double a, double b, double width) {
    const double close = std::max(0.0, width - std::abs(a - b));
    return std::min(a, b) - close * close / (4.0 * width);
}

void cut_by_planes(Body& body, double sharpness, Rng& rng) {
    const int n_sides = 4 + static_cast<int>(rng.below(5));
    const double turn = rng.uniform(0.0, 2.0 * std::numbers::pi);
    for (int k = 0; k < n_sides; ++k) {
        const double azimuth =
            turn + 2.0 * std::numbers::pi * (k + rng.uniform(-0.3, 0.3)) / n_sides;
        const double lean = rng.uniform(0.08, 0.7);
        body.planes.emplace_back(std::cos(azimuth), std::sin(azimuth), lean,
                                 rng.uniform(0.72, 0.95));
    }
    const int n_tops = 1 + static_cast<int>(rng.below(4));
    for (int k = 0; k < n_tops; ++k) {
        const double azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
        const double lean = rng.uniform(0.1, 0.8);
        body.planes.emplace_back(lean * std::cos(azimuth), lean * std::sin(azimuth), 1.0,
                                 rng.uniform(0.5, 0.85));
    }
    body.bevel = 0.02 + 0.3 * (1.0 - sharpness) * rng.uniform();
}

}  // namespace

glm::dvec2 to_local(const Body& body, glm::dvec2 p) {
    const glm::dvec2 d = p - body.centre;
    const double c = std::cos(body.azimuth);
    const double s = std::sin(body.azimuth);
    return {(c * d.x + s * d.y) / body.axes.x, (c * d.y - s * d.x) / body.axes.y};
}

double relative_height(const Body& body, glm::dvec2 local) {
    if (body.kind == BodyKind::Thing)
        return thing_height(body, local);
    const double reach = std::max(std::abs(local.x), std::abs(local.y));
    if (reach > 1.3)
        return -1.0;
    const glm::dvec2 wave{smooth_noise(body.seed, local.x + 9.0, local.y, 0.7) - 0.5,
                          smooth_noise(body.seed + 1, local.x, local.y + 9.0, 0.7) - 0.5};
    const glm::dvec2 q = local * 1.04 + 2.0 * body.waviness * wave;
    const double power = body.squareness;
    const double rho =
        std::pow(std::pow(std::abs(q.x), power) + std::pow(std::abs(q.y), power), 1.0 / power);
    if (rho >= 1.0)
        return -1.0;
    double height = std::sqrt(1.0 - std::pow(rho, body.fullness));
    for (const glm::dvec4& plane : body.planes)
        height = soft_min(height, (plane.w - plane.x * q.x - plane.y * q.y) / plane.z, body.bevel);
    return height;
}

Body make_rock(const SceneOptions& o, double diameter, std::uint64_t index) {
    Rng rng({.seed = o.seed, .stream = kRockStream, .cell = index});
    Body body;
    body.seed = o.seed * 1000003 + index * 17;
    const double stretch = 1.0 + (o.elongation - 1.0) * rng.uniform(0.2, 1.8);
    body.axes = 0.5 * diameter * glm::dvec2(std::sqrt(stretch), 1.0 / std::sqrt(stretch));
    body.azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
    body.thickness = body.axes.y * std::clamp(o.flatness * std::exp(0.25 * rng.normal()), 0.1, 1.3);
    body.fullness = rng.uniform(1.8, 3.5);
    body.squareness = rng.uniform(1.9, 2.8);
    body.waviness = o.roughness * rng.uniform(0.1, 0.45);
    body.bumps = o.roughness * rng.uniform(0.02, 0.12);
    if (rng.uniform() < o.angularity + 0.1) {
        body.axes *= 1.12;
        cut_by_planes(body, o.angularity, rng);
    }
    body.look = draw_look(o, index);
    return body;
}

}  // namespace scree::test
