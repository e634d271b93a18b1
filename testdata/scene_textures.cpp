#include "base/random.h"
#include "base/whole_file.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// Small pictures of sand, mud and pebbles that repeat without a seam, for the scenes of ground that
// gives way: scene_textures DIR.
namespace {

using namespace scree;

constexpr int kSide = 256;

// Smooth noise on a lattice of `cells` by `cells` that repeats; 0 to 1.
double noise(double u, double v, int cells, std::uint64_t seed) {
    const auto corner = [&](int x, int y) {
        const auto wrapped = [&](int i) {
            return static_cast<std::uint64_t>((i % cells + cells) % cells);
        };
        return Rng({.seed = seed, .stream = 31, .step = wrapped(y), .cell = wrapped(x)}).uniform();
    };
    const double x = u * cells;
    const double y = v * cells;
    const int ix = static_cast<int>(std::floor(x));
    const int iy = static_cast<int>(std::floor(y));
    const auto fade = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double s = fade(x - ix);
    const double t = fade(y - iy);
    return glm::mix(glm::mix(corner(ix, iy), corner(ix + 1, iy), s),
                    glm::mix(corner(ix, iy + 1), corner(ix + 1, iy + 1), s), t);
}

double octaves(double u, double v, int cells, int n, std::uint64_t seed) {
    double sum = 0.0, weight = 1.0, total = 0.0;
    for (int i = 0; i < n && cells <= kSide; ++i, cells *= 2, weight *= 0.55) {
        sum += weight * noise(u, v, cells, seed + static_cast<std::uint64_t>(i));
        total += weight;
    }
    return sum / total;
}

template <class Colour>
Photo painted(Colour&& colour) {
    Photo photo(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            photo(x, y) = glm::u8vec3(
                glm::clamp(glm::round(colour((x + 0.5) / kSide, (y + 0.5) / kSide)), 0.0, 255.0));
    return photo;
}

glm::dvec3 sand(double u, double v) {
    const double grain = noise(u, v, 128, 1) + noise(u, v, 256, 2) - 1.0;
    const double dark = std::max(0.0, noise(u, v, 128, 3) - 0.86) * 5.0;
    const double patch = octaves(u, v, 4, 4, 4) - 0.5;
    return glm::dvec3(203, 172, 125) * (1.0 + 0.16 * grain + 0.10 * patch - 0.5 * dark);
}

glm::dvec3 mud(double u, double v) {
    const double clod = octaves(u, v, 6, 6, 11) - 0.5;
    const double wet = std::max(0.0, octaves(u, v, 3, 3, 12) - 0.5);
    return glm::dvec3(98, 76, 57) * (1.0 + 0.9 * clod - 0.6 * wet) + glm::dvec3(2, 3, 5) * wet;
}

struct Pebble {
    glm::dvec2 centre{0.0};  // of a tile of side 1
    glm::dvec2 radii{0.0};
    double turn = 0.0;
    glm::dvec3 colour{0.0};
    double base = 0.0;
};

std::vector<Pebble> pebbles() {
    std::vector<Pebble> all;
    Rng rng({.seed = 21, .stream = 8});
    for (int i = 0; i < 900; ++i) {
        Pebble p;
        const double size = 0.016 + 0.055 * std::pow(rng.uniform(), 2.2);
        p.centre = {rng.uniform(), rng.uniform()};
        p.radii = {size, size * rng.uniform(0.62, 0.95)};
        p.turn = rng.uniform(0.0, 3.14159);
        const double grey = rng.uniform(95, 190);
        const double warm = rng.uniform(-6, 16);
        p.colour = {grey + warm, grey + 0.4 * warm, grey - warm};
        p.base = rng.uniform(0.0, 0.02);
        all.push_back(p);
    }
    return all;
}

// Height above the bed in shares of the tile's side, and which pebble is on top.
std::pair<double, const Pebble*> pebble_at(const std::vector<Pebble>& all, double u, double v) {
    double top = 0.0;
    const Pebble* found = nullptr;
    for (const Pebble& p : all) {
        glm::dvec2 d = glm::dvec2(u, v) - p.centre;
        d -= glm::round(d);  // the nearest of its copies
        const glm::dvec2 own = glm::dvec2(d.x * std::cos(p.turn) + d.y * std::sin(p.turn),
                                          d.y * std::cos(p.turn) - d.x * std::sin(p.turn)) /
                               p.radii;
        const double left = 1.0 - std::pow(std::abs(own.x), 2.3) - std::pow(std::abs(own.y), 2.3);
        if (left <= 0.0)
            continue;
        const double height = p.base + 0.75 * p.radii.y * std::pow(left, 0.45);
        if (height > top) {
            top = height;
            found = &p;
        }
    }
    return {top, found};
}

void write_pebbles(const std::filesystem::path& folder) {
    constexpr double kTileM = 0.5;
    const std::vector<Pebble> all = pebbles();
    vision::HeightImage relief{FloatRaster(kSide, kSide), kTileM / kSide};
    const Photo photo = painted([&](double u, double v) {
        const auto [height, pebble] = pebble_at(all, u, v);
        relief.metres(static_cast<int>(u * kSide), static_cast<int>(v * kSide)) =
            static_cast<float>(kTileM * height);
        if (pebble == nullptr)
            return glm::dvec3(58, 52, 46);
        const double speck = 0.86 + 0.28 * octaves(u, v, 64, 3, 41);
        return pebble->colour * speck * std::min(1.0, 0.45 + 16.0 * height);
    });
    write_whole_file(folder / "pebbles_albedo.jpg",
                     std::span<const std::uint8_t>(vision::encode_jpeg(photo, 85)));
    OutputBatch batch;
    vision::write_heights_png(batch.stage(folder / "pebbles_height.png"), relief);
    batch.commit();
}

}  // namespace

int main(int n_words, char** words) {
    if (n_words != 2) {
        std::cerr << "usage: scene_textures DIR\n";
        return 2;
    }
    const std::filesystem::path folder = words[1];
    std::filesystem::create_directories(folder);
    write_whole_file(folder / "sand_albedo.jpg",
                     std::span<const std::uint8_t>(vision::encode_jpeg(painted(sand), 82)));
    write_whole_file(folder / "mud_albedo.jpg",
                     std::span<const std::uint8_t>(vision::encode_jpeg(painted(mud), 85)));
    write_pebbles(folder);
    return 0;
}
