#include "testdata/scene_light.h"

#include "base/parallel.h"
#include "testdata/blur.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::test {
namespace {

struct Scene {
    const Heap& heap;
    const SceneOptions& options;
    glm::dvec3 light;
    glm::dvec3 ground;
    double top;           ///< Greatest height: above it nothing casts a shadow.
    FloatRaster near;     ///< Mean height around: what shades crevices.
    FloatRaster far;      ///< The same over a wider neighbourhood: what shades gaps of large rocks.
    FloatRaster foreign;  ///< Share of direct light that things outside the picture let through.
};

double clamped(const FloatRaster& height, int x, int y) {
    return height(std::clamp(x, 0, height.width() - 1), std::clamp(y, 0, height.height() - 1));
}

double lit_share(const Scene& scene, glm::ivec2 p) {
    const FloatRaster& height = scene.heap.height;
    const double flat = std::max(1e-9, std::hypot(scene.light.x, scene.light.y));
    const glm::dvec2 towards = glm::dvec2(scene.light.x, scene.light.y) / flat;
    const double slope = scene.light.z / flat;
    const double start = height(p.x, p.y);
    double lit = 1.0;
    for (double way = 1.5; way < 260.0 && lit > 0.0 && start + way * slope < scene.top;
         way = way * 1.04 + 0.8) {
        const int x = static_cast<int>(std::floor(p.x + 0.5 + way * towards.x));
        const int y = static_cast<int>(std::floor(p.y + 0.5 + way * towards.y));
        if (!height.contains(x, y))
            break;
        const double above = height(x, y) - (start + way * slope);
        const double penumbra = 0.8 + 1.2 * scene.options.softness * way;
        lit = std::min(lit, std::clamp(0.5 - above / penumbra, 0.0, 1.0));
    }
    return lit;
}

glm::dvec3 rock_albedo(const Body& body, glm::dvec2 local, glm::ivec2 p, const SceneOptions& o) {
    const Look& look = body.look;
    const double size = 2.0 * std::sqrt(body.axes.x * body.axes.y);
    const glm::dvec2 at = local * body.axes;
    const auto noise = [&](std::uint64_t k, double width) {
        return fractal_noise(body.seed + 11 * k, at.x, at.y, std::max(2.0, width), 4);
    };
    glm::dvec3 colour = look.albedo;
    if (look.layers > 0.0) {
        const double phase = local.y / look.layer_width + 0.8 * noise(5, 0.5 * size);
        const double band = smooth_noise(body.seed + 6, phase + 50.0, 0.5, 0.5);
        colour = glm::mix(colour, look.second, look.layers * glm::smoothstep(0.4, 0.6, band));
    }
    if (look.patches > 0.0) {
        const double patch = noise(7, 0.35 * size);
        colour = glm::mix(colour, look.second, look.patches * glm::smoothstep(0.12, 0.3, patch));
    }
    colour *= std::max(0.2, 1.0 + 0.9 * o.texture * noise(8, 0.3 * size));
    if (look.vein > 0.0) {
        const double line = local.x * 0.7 + local.y * 0.5 + 0.25 * noise(9, 0.6 * size);
        const double width = 0.015 + 0.035 * lattice(body.seed, 3, 3);
        const double second = local.x * 0.3 - local.y * 0.8 + 0.2 * noise(10, 0.6 * size) - 0.2;
        const double off = std::min(std::abs(line), std::abs(second) + 0.015);
        colour = glm::mix(colour, look.second,
                          look.vein * (1.0 - glm::smoothstep(0.4 * width, width, off)));
    }
    const double speck = smooth_noise(body.seed + 12, p.x, p.y, look.speck_width);
    // Light and dark grains between which the rock's own colour shows.
    const double sharp =
        glm::smoothstep(0.66, 0.74, speck) + glm::smoothstep(0.26, 0.34, speck) - 1.0;
    return glm::clamp(colour * std::max(0.15, 1.0 + 0.8 * look.specks * sharp), 0.008, 0.95);
}

glm::dvec3 sand_albedo(const Scene& scene, glm::ivec2 p) {
    const SceneOptions& o = scene.options;
    const double fine = lattice(o.seed + 61, p.x / 2, p.y / 2) + lattice(o.seed + 62, p.x, p.y) - 1;
    const double coarse = fractal_noise(o.seed + 63, p.x, p.y, 24.0, 4);
    return scene.ground * std::max(0.2, 1.0 + o.grain * (0.7 * fine + 0.5 * coarse));
}

glm::dvec3 surface_colour(const Scene& scene, glm::ivec2 p) {
    const std::int32_t index = scene.heap.owner(p.x, p.y);
    const glm::dvec3 sand = sand_albedo(scene, p);
    if (index < 0)
        return sand;
    const Body& body = scene.heap.bodies[static_cast<std::size_t>(index)];
    const glm::dvec2 local = to_local(body, glm::dvec2(p) + 0.5);
    if (body.kind == BodyKind::Thing)
        return thing_albedo(body, local);
    const glm::dvec3 rock = rock_albedo(body, local, p, scene.options);
    const SceneOptions& o = scene.options;
    const double over = scene.heap.height(p.x, p.y) - scene.heap.ground(p.x, p.y);
    const double low = std::exp(-std::max(0.0, over) / 6.0);
    const double settled = fractal_noise(o.seed + 64, p.x, p.y, 14.0, 4) + 1.1 * low - 0.55;
    return glm::mix(rock, sand, o.dust * glm::smoothstep(0.0, 0.4, settled));
}

glm::dvec3 normal_at(const FloatRaster& height, glm::ivec2 p) {
    glm::dvec2 slope(clamped(height, p.x - 1, p.y) - clamped(height, p.x + 1, p.y),
                     clamped(height, p.x, p.y - 1) - clamped(height, p.x, p.y + 1));
    slope *= 0.5;
    // Edges of rocks are walls of the height field; a lens sees them rounded.
    slope /= 1.0 + glm::length(slope) / 2.5;
    return glm::normalize(glm::dvec3(slope, 1.0));
}

glm::dvec3 radiance(const Scene& scene, glm::ivec2 p) {
    const SceneOptions& o = scene.options;
    const FloatRaster& h = scene.heap.height;
    const glm::dvec3 normal = normal_at(h, p);
    const double facing = std::max(0.0, glm::dot(normal, scene.light));
    const double direct = facing > 0.0 && o.sun > 0.0 ? lit_share(scene, p) : 0.0;
    const double sun = direct * facing * scene.foreign(p.x, p.y);
    const double here = h(p.x, p.y);
    const double crevice = std::max(0.0, (scene.near(p.x, p.y) - here) / 3.0);
    const double gap = std::max(0.0, (scene.far(p.x, p.y) - here) / 10.0);
    const double sky = (0.45 + 0.55 * normal.z) / (1.0 + 0.6 * crevice + 0.8 * gap);
    const std::int32_t index = scene.heap.owner(p.x, p.y);
    const double gloss =
        index < 0 ? 0.0 : scene.heap.bodies[static_cast<std::size_t>(index)].look.gloss;
    const glm::dvec3 half = glm::normalize(scene.light + glm::dvec3(0, 0, 1));
    const double gleam = std::pow(std::max(0.0, glm::dot(normal, half)), 120.0);
    const glm::dvec3 sky_tint = glm::mix(glm::dvec3(1.0), glm::dvec3(0.8, 0.95, 1.2), o.sun);
    const glm::dvec3 light =
        glm::dvec3(1.5, 1.45, 1.35) * (o.sun * sun) + sky_tint * ((1.0 - 0.72 * o.sun) * sky);
    return surface_colour(scene, p) * light +
           glm::dvec3(gloss * (0.9 * o.sun * sun * gleam + 0.06 * sky * normal.z));
}

// Trees, a tripod, the photographer: patches with straight or ragged rims.
FloatRaster foreign_shadows(const SceneOptions& o, int width, int height) {
    FloatRaster share(width, height, 1.0F);
    if (o.foreign_shadow <= 0.0)
        return share;
    const double turn = 2.0 * std::numbers::pi * lattice(o.seed, 71, 0);
    const double level = width * (0.2 + 0.6 * lattice(o.seed, 71, 1));
    const bool is_straight = lattice(o.seed, 71, 2) < 0.5;
    const double size = 60.0 + 300.0 * lattice(o.seed, 71, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double along =
                (x - width / 2) * std::cos(turn) + (y - height / 2) * std::sin(turn) + width / 2;
            const bool dark =
                is_straight ? along < level && std::fmod(along + 1e4, 0.8 * size + 90.0) < size
                            : fractal_noise(o.seed + 72, x, y, size, 3) > 0.12;
            share(x, y) = dark ? static_cast<float>(1.0 - o.foreign_shadow) : 1.0F;
        }
    return blurred(share, 1.0 + 30.0 * o.softness);
}

}  // namespace

std::array<FloatRaster, 3> light_heap(const Heap& heap, const SceneOptions& o) {
    const double azimuth = o.light_azimuth * std::numbers::pi / 180.0;
    const double elevation = o.light_elevation * std::numbers::pi / 180.0;
    const double flat = std::cos(elevation);
    const int width = heap.height.width();
    const int height = heap.height.height();
    const Scene scene{heap,
                      o,
                      {flat * std::cos(azimuth), flat * std::sin(azimuth), std::sin(elevation)},
                      ground_albedo(o),
                      *std::max_element(heap.height.begin(), heap.height.end()) + 1.0,
                      blurred(heap.height, 4.0),
                      blurred(heap.height, 16.0),
                      foreign_shadows(o, width, height)};
    std::array<FloatRaster, 3> light;
    light.fill(FloatRaster(width, height));
    parallel_for_each_index(0, static_cast<std::size_t>(height), 8, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 colour = radiance(scene, {x, y});
            for (int c = 0; c < 3; ++c)
                light[static_cast<std::size_t>(c)](x, y) = static_cast<float>(colour[c]);
        }
    });
    return light;
}

}  // namespace scree::test
