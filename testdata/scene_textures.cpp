#include "base/random.h"
#include "base/whole_file.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <span>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

// Small pictures of sand and mud that repeat without a seam, for the scenes of ground that
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
    return 0;
}
