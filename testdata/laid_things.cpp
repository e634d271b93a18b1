#include "testdata/laid_things.h"

#include "testdata/blur.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::test {
namespace {

/// A limb between two points; lengths in half widths of a finger, +y towards the fingertips.
struct Limb {
    glm::dvec2 from, to;
    double thick, thin;
    bool finger = false;
};

glm::dvec2 towards(double angle) {
    return {std::sin(angle), std::cos(angle)};
}

std::vector<Limb> limbs_of(double spread) {
    std::vector<Limb> limbs;
    constexpr std::array<double, 4> kLengths = {6.2, 7.0, 6.5, 5.0};
    for (int k = 0; k < 4; ++k) {
        const double side = k - 1.0;  // the second finger is the middle one
        const glm::dvec2 from(1.95 * side, -0.35 * side * side);
        limbs.push_back({from,
                         from + kLengths[static_cast<std::size_t>(k)] * towards(spread * side), 1.0,
                         0.78, true});
    }
    limbs.push_back({{-2.6, -4.2}, {-5.6, -1.4}, 1.25, 0.9, true});  // the thumb
    for (const double x : {-0.7, 1.1, 2.4})
        limbs.push_back({{0.6 * x + 0.5, -6.6}, {x, -1.0}, 2.2, 1.6});
    limbs.push_back({{0.7, -24.0}, {0.6, -7.0}, 3.0, 2.3});
    return limbs;
}

struct Spot {
    double height = 0.0;  ///< 0 outside of the hand.
    double crease = 1.0;
    bool nail = false;
};

Spot spot_at(const std::vector<Limb>& limbs, glm::dvec2 p) {
    Spot spot;
    for (const Limb& limb : limbs) {
        const glm::dvec2 axis = limb.to - limb.from;
        const double along =
            std::clamp(glm::dot(p - limb.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
        const double radius = glm::mix(limb.thick, limb.thin, along);
        const double off = glm::length(p - limb.from - along * axis);
        if (off >= radius)
            continue;
        spot.height = std::max(spot.height, std::sqrt(radius * radius - off * off));
        if (!limb.finger)
            continue;
        for (const double joint : {0.36, 0.68})
            if (std::abs(along - joint) < 0.025 && off < 0.8 * radius)
                spot.crease = 0.72;
        spot.nail = spot.nail || (along > 0.87 && off < 0.62 * radius);
    }
    return spot;
}

}  // namespace

Mask lay_ruler(Photo& photo, const RulerOptions& options) {
    const glm::dvec2 ahead(std::cos(options.azimuth), std::sin(options.azimuth));
    const glm::dvec2 aside(-ahead.y, ahead.x);
    const glm::dvec2 half = options.half_size;
    const double field = half.y;
    Mask mask(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y)
        for (int x = 0; x < photo.width(); ++x) {
            const glm::dvec2 from = glm::dvec2(x, y) - options.centre;
            const glm::dvec2 p(glm::dot(from, ahead), glm::dot(from, aside));
            if (std::abs(p.x) > half.x || std::abs(p.y) > half.y)
                continue;
            mask(x, y) = 255;
            const double along = p.x + half.x;
            const bool black =
                p.y > 0.2 * half.y && p.y < 0.85 * half.y && std::fmod(along, 2.0 * field) < field;
            const bool tick = p.y < -0.4 * half.y && std::fmod(along, 0.25 * field) < 1.0;
            const double grey = (black || tick ? 30.0 : 225.0) + 12.0 * (lattice(9, x, y) - 0.5);
            photo(x, y) = glm::u8vec3(glm::dvec3(grey, grey, 0.97 * grey));
        }
    return mask;
}

Mask lay_hand(Photo& photo, const HandOptions& options) {
    const std::vector<Limb> limbs = limbs_of(options.spread);
    const glm::dvec2 ahead(std::cos(options.azimuth), std::sin(options.azimuth));
    const glm::dvec2 aside(-ahead.y, ahead.x);
    const auto local = [&](double x, double y) {
        const glm::dvec2 p = (glm::dvec2(x, y) - options.knuckles) / options.finger;
        return glm::dvec2(glm::dot(p, aside), glm::dot(p, ahead));
    };
    const int width = photo.width();
    const int height = photo.height();
    FloatRaster dome(width, height);
    FloatRaster shade(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            dome(x, y) = static_cast<float>(spot_at(limbs, local(x, y)).height * options.finger);
            const double away = 1.2 * options.finger;
            shade(x, y) = spot_at(limbs, local(x - away, y - 0.7 * away)).height > 0 ? 1.0F : 0.0F;
        }
    const FloatRaster soft = blurred(dome, 0.2 * options.finger);
    const FloatRaster shadow = blurred(shade, 0.4 * options.finger);
    Mask mask(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Spot spot = spot_at(limbs, local(x, y));
            if (spot.height <= 0.0) {
                photo(x, y) = glm::u8vec3(glm::dvec3(photo(x, y)) * (1.0 - 0.5 * shadow(x, y)));
                continue;
            }
            mask(x, y) = 255;
            const auto at = [&](int dx, int dy) {
                return double{
                    soft(std::clamp(x + dx, 0, width - 1), std::clamp(y + dy, 0, height - 1))};
            };
            const glm::dvec3 normal =
                glm::normalize(glm::dvec3(at(-1, 0) - at(1, 0), at(0, -1) - at(0, 1), 2.0));
            const double lit =
                0.3 +
                0.75 * std::max(0.0, glm::dot(normal, glm::normalize(glm::dvec3(-0.5, -0.4, 0.8))));
            const double pores = 1.0 + 0.05 * fractal_noise(5, x, y, 0.15 * options.finger, 3) +
                                 0.08 * fractal_noise(6, x, y, 2.0 * options.finger, 2);
            glm::dvec3 colour = options.skin * (lit * pores * spot.crease);
            if (spot.nail)
                colour = glm::mix(colour, glm::dvec3(235.0, 195.0, 185.0) * lit, 0.6);
            photo(x, y) = glm::u8vec3(glm::clamp(colour, 0.0, 255.0) + 0.5);
        }
    return mask;
}

}  // namespace scree::test
