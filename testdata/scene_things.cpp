#include "base/random.h"
#include "testdata/lattice_noise.h"
#include "testdata/scene_bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::test {
namespace {

constexpr std::uint64_t kThingStream = 34;
constexpr double kPi = std::numbers::pi;

// Ink of made-up glyphs on a grid of 3 x 5 dots, each with a dot of space.
bool is_ink(std::uint64_t seed, double x, double y) {
    const double column = std::floor(x / 4.0);
    const double row = std::floor(y / 7.0);
    const double i = std::floor(x - 4.0 * column);
    const double j = std::floor(y - 7.0 * row);
    if (i >= 3.0 || j >= 5.0)
        return false;
    const auto cell = static_cast<std::int64_t>(1000.0 * row + column);
    const auto dot = static_cast<std::int64_t>(3.0 * j + i);
    return lattice(seed, cell, dot) < 0.55;
}

glm::dvec3 ruler_albedo(const Body& body, glm::dvec2 local) {
    const glm::dvec2 p = (local + 1.0) * body.axes;  // canvas pixels from a corner
    const double unit = std::max(8.0, 0.4 * body.axes.y);
    const double tick = std::fmod(p.x, unit) / unit;
    const bool is_long = std::fmod(p.x, 5.0 * unit) < unit;
    if (tick < 0.2 && p.y < body.axes.y * (is_long ? 0.9 : 0.45))
        return glm::dvec3(0.03);
    const double dot = std::max(1.5, 0.12 * body.axes.y);
    const double within = std::fmod(p.x, 5.0 * unit) / dot;
    if (p.y > 1.05 * body.axes.y && within > 1.0 && within < 8.0 &&
        is_ink(body.seed + static_cast<std::uint64_t>(p.x / (5.0 * unit)), within,
               (p.y - 1.05 * body.axes.y) / dot))
        return glm::dvec3(0.04);
    return body.look.albedo;
}

glm::dvec3 card_albedo(const Body& body, glm::dvec2 local) {
    const glm::dvec2 p = (local + 1.0) * body.axes;
    const double rim = std::min({p.x, p.y, 2.0 * body.axes.x - p.x, 2.0 * body.axes.y - p.y});
    if (rim < 0.08 * body.axes.y)
        return body.look.albedo;
    const double cells = 2.0 + static_cast<double>(body.seed % 4);
    const auto column = static_cast<std::int64_t>((local.x + 1.0) * cells);
    const auto row = static_cast<std::int64_t>((local.y + 1.0) * 0.5 * cells);
    if (body.seed % 3 == 0)  // chequers
        return glm::dvec3((column + row) % 2 == 0 ? 0.03 : 0.8);
    if (body.seed % 3 == 1) {  // colour patches
        const auto part = [&](std::uint64_t c) { return lattice(body.seed + c, column, row); };
        return 0.03 + 0.7 * glm::dvec3(part(1), part(2), part(3));
    }
    const double dot = std::max(1.5, 0.03 * body.axes.y);  // print
    return is_ink(body.seed, p.x / dot, p.y / dot) ? glm::dvec3(0.05) : body.look.albedo;
}

glm::dvec3 shell_albedo(const Body& body, glm::dvec2 local) {
    const glm::dvec2 from_hinge = local - glm::dvec2(0.0, 0.9);
    const double band =
        0.5 + 0.5 * std::sin(glm::length(from_hinge) * 18.0 + static_cast<double>(body.seed % 7));
    const double rib = 0.5 + 0.5 * std::cos(40.0 * std::atan2(from_hinge.x, -from_hinge.y));
    return glm::mix(body.look.albedo, body.look.second, 0.5 * band) * (0.75 + 0.25 * rib);
}

double curve_of(const Body& body, double u) {
    const auto phase = static_cast<double>(body.seed % 17);
    return 0.45 * std::sin(1.7 * u + phase) + 0.2 * std::sin(4.1 * u + 2.0 * phase);
}

double twig_height(const Body& body, glm::dvec2 local) {
    const double width = 0.25 * (1.0 - 0.5 * (0.5 + 0.5 * local.x));
    const double across = (local.y - curve_of(body, local.x)) / width;
    if (std::abs(local.x) > 1.0 || std::abs(across) >= 1.0)
        return -1.0;
    return std::sqrt(1.0 - across * across);
}

double shell_height(glm::dvec2 local) {
    const glm::dvec2 from_hinge = local - glm::dvec2(0.0, 0.9);
    const double angle = std::atan2(from_hinge.x, -from_hinge.y);
    const double reach = 1.8 * std::cos(0.75 * angle) * (1.0 + 0.02 * std::cos(30.0 * angle));
    const double rho = glm::length(from_hinge) / std::max(0.05, reach);
    if (std::abs(angle) > 0.6 * kPi || rho >= 1.0)
        return -1.0;
    return std::sqrt(std::max(0.0, 1.0 - rho * rho)) * (0.85 + 0.08 * std::cos(40.0 * angle));
}

double leaf_height(glm::dvec2 local) {
    const double side = std::pow(std::max(0.0, 1.0 - local.x * local.x), 1.3);
    if (std::abs(local.x) >= 1.0 || std::abs(local.y) >= side)
        return -1.0;
    return 0.5 + 0.4 * std::abs(local.y) + 0.1 * std::sin(6.0 * local.x);
}

struct Size {
    double least;
    double greatest;
    double aspect;  ///< Shorter over longer half axis.
    double thickness;
};

Size size_of(ThingKind kind, Rng& rng) {
    switch (kind) {
        case ThingKind::Ruler:
            return {220, 900, rng.uniform(0.06, 0.14), 6};
        case ThingKind::Card:
            return {60, 240, rng.uniform(0.35, 1.0), 5};
        case ThingKind::Coin:
            return {20, 80, 1.0, 7};
        case ThingKind::Shell:
            return {18, 90, rng.uniform(0.75, 1.1), 16};
        case ThingKind::Twig:
            return {80, 500, rng.uniform(0.05, 0.15), 7};
        case ThingKind::Leaf:
            break;
    }
    return {30, 160, rng.uniform(0.25, 0.55), 7};
}

glm::dvec3 colour_of(ThingKind kind, Rng& rng) {
    const double grey = rng.uniform(0.75, 1.1);
    switch (kind) {
        case ThingKind::Ruler:
        case ThingKind::Card:
            return rng.uniform() < 0.6 ? glm::dvec3(0.78) * grey
                                       : glm::dvec3(0.75, 0.55, 0.08) * grey;
        case ThingKind::Coin:
            return rng.uniform() < 0.5 ? glm::dvec3(0.45, 0.45, 0.43) * grey
                                       : glm::dvec3(0.42, 0.26, 0.13) * grey;
        case ThingKind::Shell:
            return glm::dvec3(0.75, 0.66, 0.55) * grey;
        case ThingKind::Twig:
            return glm::dvec3(0.16, 0.10, 0.06) * rng.uniform(0.5, 2.5);
        case ThingKind::Leaf:
            break;
    }
    return rng.uniform() < 0.5 ? glm::dvec3(0.10, 0.22, 0.04) * grey
                               : glm::dvec3(0.28, 0.16, 0.06) * grey;
}

}  // namespace

double thing_height(const Body& body, glm::dvec2 local) {
    switch (body.thing) {
        case ThingKind::Ruler:
        case ThingKind::Card:
            return std::max(std::abs(local.x), std::abs(local.y)) < 1.0 ? 1.0 : -1.0;
        case ThingKind::Coin: {
            const double rho = glm::length(local);
            const double relief = 0.12 * smooth_noise(body.seed, local.x + 3.0, local.y, 0.22);
            return rho >= 1.0 ? -1.0 : rho > 0.9 ? 1.0 : 0.85 + (rho < 0.6 ? relief : 0.0);
        }
        case ThingKind::Shell:
            return shell_height(local);
        case ThingKind::Twig:
            return twig_height(body, local);
        case ThingKind::Leaf:
            break;
    }
    return leaf_height(local);
}

glm::dvec3 thing_albedo(const Body& body, glm::dvec2 local) {
    switch (body.thing) {
        case ThingKind::Ruler:
            return ruler_albedo(body, local);
        case ThingKind::Card:
            return card_albedo(body, local);
        case ThingKind::Shell:
            return shell_albedo(body, local);
        case ThingKind::Leaf:
            return body.look.albedo * (std::abs(local.y) < 0.04 ? 1.6 : 1.0);
        case ThingKind::Coin:
        case ThingKind::Twig:
            break;
    }
    return body.look.albedo * (0.8 + 0.4 * smooth_noise(body.seed, 9.0 * local.x, local.y, 0.3));
}

Body make_thing(const SceneOptions& o, std::uint64_t index) {
    Rng rng({.seed = o.seed, .stream = kThingStream, .cell = index});
    Body body;
    body.kind = BodyKind::Thing;
    body.thing = static_cast<ThingKind>(rng.below(kThingKinds));
    body.seed = rng.bits() % 1000003;
    const Size size = size_of(body.thing, rng);
    const double half = size.least * std::pow(size.greatest / size.least, rng.uniform());
    body.axes = {half, half * size.aspect};
    body.azimuth = rng.uniform(0.0, 2.0 * kPi);
    body.thickness = size.thickness * rng.uniform(0.6, 1.6);
    body.look.albedo = glm::clamp(colour_of(body.thing, rng), 0.02, 0.9);
    body.look.second = body.look.albedo * glm::dvec3(0.6, 0.45, 0.4);
    body.look.gloss = body.thing == ThingKind::Coin ? 0.5 : 0.0;
    return body;
}

}  // namespace scree::test
