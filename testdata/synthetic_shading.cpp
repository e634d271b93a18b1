#include "testdata/synthetic_shading.h"

#include "base/parallel.h"
#include "base/random.h"
#include "testdata/blur.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace scree::test {
namespace {

constexpr std::uint64_t kColourStream = 21;
constexpr std::uint64_t kNoiseStream = 22;
constexpr double kDegree = std::numbers::pi / 180.0;

struct Look {
    glm::dvec3 albedo{0.3};
    glm::dvec2 tilt{0.0};
    double dome = 0.8;
};

std::vector<Look> draw_looks(std::size_t n_rocks, const SyntheticOptions& o) {
    std::vector<Look> looks;
    for (std::size_t i = 0; i < n_rocks; ++i) {
        Rng rng({.seed = o.seed, .stream = kColourStream, .cell = i});
        Look look;
        const double grey = 0.32 * std::exp(1.2 * o.colour * rng.normal());
        const double warm = 0.35 * o.colour * rng.normal();
        look.albedo = glm::dvec3(1.0 + warm, 1.0 + 0.35 * warm, 1.0 - warm) *
                      std::clamp(grey, 0.06, 0.8) * (1.0 - 0.45 * o.wetness);
        look.albedo = glm::clamp(look.albedo, 0.02, 0.95);
        look.tilt = 0.15 * glm::dvec2(rng.normal(), rng.normal());
        look.dome = rng.uniform(0.5, 1.0);
        looks.push_back(look);
    }
    return looks;
}

// Height of every pixel above the ground, px: flattened domes, tilted a little, and grains of sand.
FloatRaster height_map(const std::vector<vision::Outline>& outlines, const LabelMap& labels,
                       const std::vector<Look>& looks, const SyntheticOptions& o) {
    FloatRaster height(labels.width(), labels.height());
    std::vector<double> half;
    for (const auto& outline : outlines)
        half.push_back(0.5 * *std::min_element(outline.radii.begin(), outline.radii.end()));
    parallel_for_each_index(0, static_cast<std::size_t>(labels.height()), 16, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < labels.width(); ++x) {
            const std::size_t label = labels(x, y);
            const double grain = lattice(o.seed + 5, x, y);
            if (label == 0) {
                height(x, y) = static_cast<float>(o.matrix * (2.0 + 0.8 * o.grain * grain));
                continue;
            }
            const auto& outline = outlines[label - 1];
            const Look& look = looks[label - 1];
            const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - outline.centre;
            const double rho = std::min(
                1.0, std::hypot(d.x, d.y) / vision::radius_at(outline, std::atan2(d.y, d.x)));
            const double dome = std::sqrt(1.0 - rho * rho * rho);
            const double bump = smooth_noise(o.seed + label, x, y, 7.0) - 0.5;
            height(x, y) =
                static_cast<float>(half[label - 1] * look.dome * dome +
                                   dome * glm::dot(look.tilt, d) + o.texture * bump * (1.0 - rho));
        }
    });
    return height;
}

double bounded(const FloatRaster& height, int x, int y) {
    return height(std::clamp(x, 0, height.width() - 1), std::clamp(y, 0, height.height() - 1));
}

// Share of the direct light that is kept: 0 where a rock stands between the pixel and the light.
double lit_share(const FloatRaster& height, glm::ivec2 p, glm::dvec2 towards, double slope) {
    double lit = 1.0;
    for (int step = 1; step <= 60; ++step) {
        const int x = p.x + static_cast<int>(std::lround(step * towards.x));
        const int y = p.y + static_cast<int>(std::lround(step * towards.y));
        if (!height.contains(x, y))
            break;
        const double above = height(x, y) - (height(p.x, p.y) + step * slope);
        lit = std::min(lit, std::clamp(1.0 - above, 0.0, 1.0));
    }
    return lit;
}

struct Scene {
    const LabelMap& labels;
    const std::vector<Look>& looks;
    FloatRaster height;
    FloatRaster around;  ///< Mean height of the neighbourhood: what shades a gap.
    glm::dvec3 light;    ///< Unit vector, image axes and up.
};

glm::dvec3 surface_colour(const Scene& scene, glm::ivec2 p, const SyntheticOptions& o) {
    const std::size_t label = scene.labels(p.x, p.y);
    if (label == 0) {
        const double grain = 1.0 + 0.5 * o.grain * (lattice(o.seed + 6, p.x, p.y) - 0.5);
        const double grey = (0.05 + 0.30 * o.matrix) * grain;
        return glm::dvec3(1.05, 1.0, 0.85) * grey;
    }
    const std::uint64_t key = o.seed * 1000003 + label;
    const double wave =
        0.6 * smooth_noise(key, p.x, p.y, 9.0) + 0.4 * smooth_noise(key + 1, p.x, p.y, 3.0) - 0.5;
    double factor = 1.0 + 1.6 * o.texture * wave;
    const double speck = smooth_noise(key + 2, p.x, p.y, 2.5);
    if (speck > 0.72)
        factor *= 1.0 + 1.5 * o.speckle;
    if (speck < 0.28)
        factor *= 1.0 - 0.8 * o.speckle;
    return scene.looks[label - 1].albedo * std::max(0.05, factor);
}

glm::dvec3 shaded(const Scene& scene, glm::ivec2 p, const SyntheticOptions& o) {
    const FloatRaster& h = scene.height;
    const glm::dvec3 slope(bounded(h, p.x - 1, p.y) - bounded(h, p.x + 1, p.y),
                           bounded(h, p.x, p.y - 1) - bounded(h, p.x, p.y + 1), 2.0);
    // Steep rims are softened: a real rock is rounder there than the dome is.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.6 * slope.x, 0.6 * slope.y, slope.z));
    const double flat = std::hypot(scene.light.x, scene.light.y);
    const glm::dvec2 towards = glm::dvec2(scene.light.x, scene.light.y) / std::max(1e-9, flat);
    const double share = lit_share(h, p, towards, scene.light.z / std::max(1e-9, flat));
    const double sun = (1.0 - o.shadow * (1.0 - share)) * std::max(0.0, dot(normal, scene.light));
    const double depth = std::max(0.0, static_cast<double>(scene.around(p.x, p.y) - h(p.x, p.y)));
    const double sky = (0.5 + 0.5 * normal.z) * std::exp(-0.25 * o.shadow * depth);
    const glm::dvec3 half = glm::normalize(scene.light + glm::dvec3(0, 0, 1));
    const double gleam = scene.labels(p.x, p.y) == 0
                             ? 0.0
                             : share * std::pow(std::max(0.0, glm::dot(normal, half)), 80.0);
    const glm::dvec3 colour = surface_colour(scene, p, o) * (1.1 * sun + 0.45 * sky);
    return colour + glm::dvec3(0.8 * o.wetness * gleam);
}

double coded(double light) {
    const double v = std::clamp(light, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

// Lens, sensor and tone curve: light to stored bytes.
Photo developed(const std::array<FloatRaster, 3>& light, const SyntheticOptions& o) {
    std::array<FloatRaster, 3> focused = light;
    if (o.blur > 0.0)
        for (auto& channel : focused)
            channel = blurred(channel, o.blur);
    Photo photo(o.width, o.height);
    parallel_for_each_index(0, static_cast<std::size_t>(o.height), 16, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        Rng rng({.seed = o.seed, .stream = kNoiseStream, .cell = row});
        for (int x = 0; x < o.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double clean = coded(focused[static_cast<std::size_t>(c)](x, y));
                const double v = 0.5 + o.contrast * (clean - 0.5) + o.noise * rng.normal();
                photo(x, y)[c] =
                    static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(v, 0.0, 1.0)));
            }
    });
    return photo;
}

}  // namespace

Photo shade_rocks(const std::vector<vision::Outline>& outlines, const LabelMap& labels,
                  const SyntheticOptions& options) {
    const std::vector<Look> looks = draw_looks(outlines.size(), options);
    Scene scene{labels, looks, height_map(outlines, labels, looks, options), {}, {}};
    scene.around = blurred(scene.height, 3.0);
    const double azimuth = options.light_azimuth * kDegree;
    const double elevation = options.light_elevation * kDegree;
    scene.light = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)};
    std::array<FloatRaster, 3> light;
    light.fill(FloatRaster(labels.width(), labels.height()));
    parallel_for_each_index(0, static_cast<std::size_t>(labels.height()), 8, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < labels.width(); ++x) {
            const glm::dvec3 colour = shaded(scene, {x, y}, options);
            for (int c = 0; c < 3; ++c)
                light[static_cast<std::size_t>(c)](x, y) = static_cast<float>(colour[c]);
        }
    });
    return developed(light, options);
}

}  // namespace scree::test
