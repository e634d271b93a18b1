#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "testdata/gravel_scene.h"
#include "testdata/ground_mosaic.h"
#include "testdata/lattice_noise.h"
#include "testdata/synthetic_photo.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::test {

namespace {

using vision::GroundClass;

glm::vec3 bytes(float r, float g, float b) {
    return glm::vec3(r, g, b) / 255.0F;
}

glm::vec3 pick(Rng& rng, std::initializer_list<glm::vec3> palette) {
    const glm::vec3 colour = palette.begin()[rng.below(palette.size())];
    const auto jitter = [&] { return static_cast<float>(1.0 + 0.06 * rng.normal()); };
    return colour * static_cast<float>(rng.uniform(0.8, 1.2)) *
           glm::vec3(jitter(), jitter(), jitter());
}

// Brightness factors by a function of the pixel, row by row in parallel.
template <class Brightness>
ColourRaster shaded(int width, int height, glm::vec3 colour, const Brightness& brightness) {
    ColourRaster out(width, height);
    parallel_for_each_index(0, static_cast<std::size_t>(height), 8, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x)
            out(x, y) = colour * static_cast<float>(std::max(0.0, brightness(x, y)));
    });
    return out;
}

// White noise softened to grains of about `size` pixels, deviation 1.
FloatRaster grains(int width, int height, double size, std::uint64_t seed) {
    FloatRaster noise(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            noise(x, y) = static_cast<float>(lattice(seed, x, y) + lattice(seed + 1, x, y) +
                                             lattice(seed + 2, x, y) - 1.5) *
                          2.0F;
    const double sigma = 0.4 * size;
    cv::Mat view(height, width, CV_32F, noise.data());
    cv::GaussianBlur(view, view, cv::Size(), sigma);
    const auto gain = static_cast<float>(std::max(1.0, 2.0 * std::sqrt(std::numbers::pi) * sigma));
    for (float& value : noise)
        value *= gain;
    return noise;
}

struct Nearest {
    double distance = 1e9;
    double second = 1e9;
    std::uint64_t id = 0;
};

// The nearest two of one point per square of a shaken grid.
Nearest nearest_points(std::uint64_t seed, double x, double y, double size) {
    const double u = x / size;
    const double v = y / size;
    const auto i = static_cast<std::int64_t>(std::floor(u));
    const auto j = static_cast<std::int64_t>(std::floor(v));
    Nearest nearest;
    for (std::int64_t dj = -1; dj <= 1; ++dj)
        for (std::int64_t di = -1; di <= 1; ++di) {
            const double px = static_cast<double>(i + di) + lattice(seed, i + di, j + dj);
            const double py = static_cast<double>(j + dj) + lattice(seed + 1, i + di, j + dj);
            const double distance = std::hypot(px - u, py - v) * size;
            if (distance < nearest.distance) {
                nearest.second = nearest.distance;
                nearest.distance = distance;
                nearest.id = static_cast<std::uint64_t>((i + di) * 7919 + (j + dj) * 104729);
            } else {
                nearest.second = std::min(nearest.second, distance);
            }
        }
    return nearest;
}

ColourRaster draw_sand(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 11});
    const glm::vec3 colour =
        pick(rng, {bytes(200, 176, 138), bytes(150, 145, 135), bytes(216, 202, 172),
                   bytes(96, 90, 84), bytes(146, 120, 88), bytes(178, 150, 110)});
    const FloatRaster grain = grains(width, height, rng.uniform(0.8, 3.0), seed * 5 + 1);
    const double grain_depth = rng.uniform(0.04, 0.14);
    const double ripple = rng.uniform() < 0.5 ? rng.uniform(0.02, 0.12) : 0.0;
    const double wave = rng.uniform(18.0, 80.0);
    const double turn = rng.uniform(0.0, std::numbers::pi);
    const double swell = rng.uniform(0.02, 0.12);
    const double swell_size = rng.uniform(60.0, 200.0);
    const double specks = rng.uniform(0.0, 0.02);
    const double speck_light = rng.uniform() < 0.7 ? 0.55 : 1.5;
    return shaded(width, height, colour, [&](int x, int y) {
        const double along = x * std::cos(turn) + y * std::sin(turn);
        const double bend = 0.6 * wave * fractal_noise(seed + 3, x, y, 3.0 * wave, 2);
        const double light = 1.0 + grain_depth * static_cast<double>(grain(x, y)) +
                             ripple * std::sin(2.0 * std::numbers::pi * (along + bend) / wave) +
                             swell * fractal_noise(seed + 4, x, y, swell_size, 3);
        return lattice(seed + 5, x, y) < specks ? light * speck_light : light;
    });
}

ColourRaster draw_mud(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 12});
    const glm::vec3 colour =
        pick(rng, {bytes(108, 84, 60), bytes(88, 74, 60), bytes(132, 106, 80), bytes(100, 95, 90),
                   bytes(74, 58, 44), bytes(140, 128, 110)});
    const FloatRaster grain = grains(width, height, rng.uniform(0.8, 2.0), seed * 5 + 2);
    const double grain_depth = rng.uniform(0.008, 0.04);
    const double lumps = rng.uniform(0.08, 0.28);
    const double lump_size = rng.uniform(14.0, 90.0);
    const bool cracked = rng.uniform() < 0.4;
    const double plate = rng.uniform(35.0, 120.0);
    const double crack = rng.uniform(1.0, 4.0);
    const double wet = rng.uniform() < 0.4 ? rng.uniform(0.2, 0.6) : 0.0;
    return shaded(width, height, colour, [&](int x, int y) {
        const double relief = fractal_noise(seed + 3, x, y, lump_size, 4);
        const double lit = relief - fractal_noise(seed + 3, x + 2.0, y + 2.0, lump_size, 4);
        double light = 1.0 + 0.4 * lumps * relief + 3.0 * lumps * lit +
                       grain_depth * static_cast<double>(grain(x, y));
        if (wet > 0.0)
            light += wet * std::max(0.0, fractal_noise(seed + 4, x, y, 90.0, 3) - 0.15);
        if (cracked) {
            const double bend = 8.0 * fractal_noise(seed + 6, x, y, 25.0, 2);
            const Nearest near = nearest_points(seed + 5, x + bend, y - bend, plate);
            const double border = near.second - near.distance;
            light *= 0.35 + 0.65 * glm::smoothstep(0.5 * crack, 2.5 * crack, border);
        }
        return light;
    });
}

ColourRaster draw_rock(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 13});
    const glm::vec3 colour =
        pick(rng, {bytes(132, 128, 122), bytes(152, 132, 112), bytes(96, 92, 90),
                   bytes(172, 166, 160), bytes(120, 110, 100), bytes(110, 118, 126)});
    const FloatRaster grain = grains(width, height, rng.uniform(0.8, 2.5), seed * 5 + 3);
    const double grain_depth = rng.uniform(0.01, 0.06);
    const double mottle = rng.uniform(0.05, 0.2);
    const double mottle_size = rng.uniform(30.0, 200.0);
    const double facet = rng.uniform(70.0, 260.0);
    const double facet_light = rng.uniform(0.05, 0.3);
    const double crack = rng.uniform(0.3, 2.5);
    const double bedding = rng.uniform() < 0.35 ? rng.uniform(0.03, 0.15) : 0.0;
    const double layer = rng.uniform(8.0, 40.0);
    const double turn = rng.uniform(0.0, std::numbers::pi);
    const double lichen = rng.uniform() < 0.35 ? rng.uniform(0.1, 0.35) : 1.0;
    const glm::vec3 patch = pick(
        rng, {bytes(170, 168, 120), bytes(190, 190, 180), bytes(70, 72, 62), bytes(180, 140, 60)});
    ColourRaster out = shaded(width, height, colour, [&](int x, int y) {
        const double bend = 12.0 * fractal_noise(seed + 6, x, y, 50.0, 3);
        const Nearest near = nearest_points(seed + 5, x + bend, y - bend, facet);
        const double tilt = lattice(seed + 7, static_cast<std::int64_t>(near.id), 3) - 0.5;
        const double along = x * std::cos(turn) + y * std::sin(turn) + bend;
        const double light = 1.0 + mottle * fractal_noise(seed + 3, x, y, mottle_size, 6) +
                             facet_light * tilt +
                             bedding * (smooth_noise(seed + 8, along, 0.0, layer) - 0.5) * 2.0 +
                             grain_depth * static_cast<double>(grain(x, y));
        const double border = near.second - near.distance;
        return light * (0.4 + 0.6 * glm::smoothstep(0.3 * crack, 2.0 * crack, border));
    });
    if (lichen < 1.0)
        parallel_for_each_index(0, static_cast<std::size_t>(height), 8, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < width; ++x) {
                const double cover = fractal_noise(seed + 9, x, y, 60.0, 4);
                const double share = glm::smoothstep(lichen, lichen + 0.1, cover);
                out(x, y) = glm::mix(out(x, y), patch, static_cast<float>(0.8 * share));
            }
        });
    return out;
}

ColourRaster draw_grass(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 14});
    const glm::vec3 blade = pick(rng, {bytes(84, 128, 44), bytes(104, 140, 60), bytes(150, 150, 70),
                                       bytes(176, 156, 90), bytes(70, 104, 40)});
    const glm::vec3 ground = pick(rng, {bytes(40, 52, 24), bytes(70, 60, 40), bytes(54, 64, 34)});
    ColourRaster out = shaded(width, height, ground, [&](int x, int y) {
        return 1.0 + 0.3 * fractal_noise(seed + 3, x, y, 30.0, 4);
    });
    cv::Mat canvas(height, width, CV_32FC3, out.data());
    const double length = rng.uniform(7.0, 40.0);
    const double spread = rng.uniform(0.25, 1.2);
    const double lean = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const double thickness = rng.uniform(0.6, 2.4);
    const double spread_light = rng.uniform(0.2, 0.45);
    const auto n_blades = static_cast<std::uint64_t>(rng.uniform(2.0, 5.0) * width * height /
                                                     (length * (thickness + 0.6)));
    constexpr double kSub = 16.0;  // fractions of a pixel in drawing
    for (std::uint64_t k = 0; k < n_blades; ++k) {
        const double x = rng.uniform(-length, width + length);
        const double y = rng.uniform(-length, height + length);
        const double turn = lean + spread * rng.normal() +
                            1.2 * (smooth_noise(seed + 7, x + 1000, y + 1000, 60.0) - 0.5);
        const double reach = length * rng.uniform(0.5, 1.3);
        const double depth = static_cast<double>(k) / static_cast<double>(n_blades);
        const glm::vec3 colour =
            blade * static_cast<float>(0.55 + 0.5 * depth + spread_light * rng.normal() * 0.7) *
            glm::vec3(static_cast<float>(1.0 + 0.08 * rng.normal()), 1.0F, 1.0F);
        const cv::Point foot(static_cast<int>(kSub * x), static_cast<int>(kSub * y));
        const cv::Point tip(static_cast<int>(kSub * (x + reach * std::cos(turn))),
                            static_cast<int>(kSub * (y + reach * std::sin(turn))));
        const int width_px = std::max(1, static_cast<int>(thickness + rng.uniform()));
        cv::line(canvas, foot, tip, cv::Scalar(colour.x, colour.y, colour.z), width_px, cv::LINE_8,
                 4);
    }
    cv::GaussianBlur(canvas, canvas, cv::Size(), 0.5);
    return out;
}

ColourRaster colours_of(const Photo& photo) {
    ColourRaster out(photo.width(), photo.height());
    std::transform(photo.begin(), photo.end(), out.begin(),
                   [](glm::u8vec3 colour) { return glm::vec3(colour) / 255.0F; });
    return out;
}

// Half of them heaps of bodies, half star-shaped stones side by side, which cost a tenth.
ColourRaster draw_pebbles(int width, int height, std::uint64_t seed) {
    Rng rng({.seed = seed, .stream = 15});
    const double least = rng.uniform(4.0, 8.0);
    const double greatest = rng.uniform(16.0, 70.0);
    if (seed % 2 == 0) {
        SceneOptions heap = varied_scene(seed * 31 + 7, width, height);
        heap.least = least;
        heap.greatest = greatest;
        heap.coverage = std::max(heap.coverage, 1.3);
        heap.pebbles = std::max(heap.pebbles, 0.2);
        heap.n_things = 0;
        heap.foreign_shadow = 0.0;
        return colours_of(make_gravel_scene(heap).photo);
    }
    SyntheticOptions stones;
    stones.width = width;
    stones.height = height;
    stones.layout = rng.uniform() < 0.4 ? Layout::Cells : Layout::Darts;
    stones.n_rocks = static_cast<int>(1.5 * width * height / (least * greatest)) + 1;
    stones.least_diameter = least;
    stones.median_diameter = std::sqrt(least * greatest);
    stones.greatest_diameter = greatest;
    stones.gap = rng.uniform(0.5, 2.5);
    stones.light_azimuth = rng.uniform(0.0, 360.0);
    stones.light_elevation = rng.uniform(25.0, 80.0);
    stones.colour = rng.uniform(0.05, 0.8);
    stones.texture = rng.uniform(0.0, 0.4);
    stones.speckle = rng.uniform(0.0, 0.5);
    stones.wetness = rng.uniform() < 0.3 ? rng.uniform() : 0.0;
    stones.matrix = rng.uniform(0.0, 0.8);
    stones.seed = seed;
    try {
        return colours_of(make_synthetic_photo(stones).photo);
    } catch (const InvalidInput&) {  // a cell was too small for its gap
        stones.layout = Layout::Darts;
        return colours_of(make_synthetic_photo(stones).photo);
    }
}

}  // namespace

ColourRaster draw_ground(GroundClass kind, int width, int height, std::uint64_t seed) {
    switch (kind) {
        case GroundClass::Sand:
            return draw_sand(width, height, seed);
        case GroundClass::Mud:
            return draw_mud(width, height, seed);
        case GroundClass::Pebbles:
            return draw_pebbles(width, height, seed);
        case GroundClass::Rock:
            return draw_rock(width, height, seed);
        case GroundClass::Grass:
            break;
    }
    return draw_grass(width, height, seed);
}

}  // namespace scree::test
