#pragma once

#include <cmath>
#include <cstdint>

namespace scree::test {

/// Random value in [0, 1) of a lattice point: cheap, since millions are asked for.
inline double lattice(std::uint64_t seed, std::int64_t x, std::int64_t y) {
    std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL;
    h ^= static_cast<std::uint64_t>(x) * 0xC2B2AE3D27D4EB4FULL;
    h ^= static_cast<std::uint64_t>(y) * 0x165667B19E3779F9ULL;
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 32)) * 0x94D049BB133111EBULL;
    return static_cast<double>((h ^ (h >> 29)) >> 11) * 0x1.0p-53;
}

/// Value noise in [0, 1] with features of `size` pixels.
inline double smooth_noise(std::uint64_t seed, double x, double y, double size) {
    const double u = x / size;
    const double v = y / size;
    const double i = std::floor(u);
    const double j = std::floor(v);
    const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double s = ease(u - i);
    const double t = ease(v - j);
    const auto corner = [&](int di, int dj) {
        return lattice(seed, static_cast<std::int64_t>(i) + di, static_cast<std::int64_t>(j) + dj);
    };
    const double top = corner(0, 0) + s * (corner(1, 0) - corner(0, 0));
    const double bottom = corner(0, 1) + s * (corner(1, 1) - corner(0, 1));
    return top + t * (bottom - top);
}

/// Octaves of value noise in [-1, 1], the coarsest with features of `size` pixels.
inline double fractal_noise(std::uint64_t seed, double x, double y, double size, int octaves) {
    double sum = 0.0;
    double weight = 0.5;
    double total = 0.0;
    for (int octave = 0; octave < octaves; ++octave) {
        const double noise =
            smooth_noise(seed + static_cast<std::uint64_t>(octave) * 7919, x, y, size);
        sum += weight * (2.0 * noise - 1.0);
        total += weight;
        weight *= 0.55;
        size *= 0.47;
    }
    return sum / total;
}

}  // namespace scree::test
