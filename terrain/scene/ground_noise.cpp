#include "terrain/scene/ground_noise.h"

#include <cmath>
#include <numbers>

namespace scree::terrain {
namespace {

// SplitMix64's finish: neighbouring corners get unrelated directions.
std::uint64_t mixed(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9ULL;
    v = (v ^ (v >> 27)) * 0x94D049BB133111EBULL;
    return v ^ (v >> 31);
}

double corner(std::int64_t ix, std::int64_t iy, double dx, double dy, std::uint64_t seed) {
    const std::uint64_t key =
        mixed(mixed(mixed(seed + 0x9E3779B97F4A7C15ULL) ^ static_cast<std::uint64_t>(ix)) ^
              (static_cast<std::uint64_t>(iy) << 1));
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(key >> 11) * 0x1.0p-53;
    return std::cos(angle) * dx + std::sin(angle) * dy;
}

double fade(double t) {
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

}  // namespace

double plane_noise(double x, double y, std::uint64_t seed) {
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto ix = static_cast<std::int64_t>(left);
    const auto iy = static_cast<std::int64_t>(top);
    const double u = x - left;
    const double v = y - top;
    const double a = corner(ix, iy, u, v, seed);
    const double b = corner(ix + 1, iy, u - 1.0, v, seed);
    const double c = corner(ix, iy + 1, u, v - 1.0, seed);
    const double d = corner(ix + 1, iy + 1, u - 1.0, v - 1.0, seed);
    const double s = fade(u);
    const double upper = a + s * (b - a);
    const double lower = c + s * (d - c);
    return std::numbers::sqrt2 * (upper + fade(v) * (lower - upper));
}

double fractal_noise(double x, double y, int octaves, std::uint64_t seed) {
    double sum = 0.0;
    double weight = 1.0;
    double total = 0.0;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * plane_noise(x, y, seed + static_cast<std::uint64_t>(i));
        total += weight;
        weight *= 0.5;
        // Turned between octaves, so that their lattices do not line up.
        const double turned = 1.6 * x + 1.2 * y;
        y = 1.6 * y - 1.2 * x + 11.3;
        x = turned + 7.7;
    }
    return total > 0.0 ? sum / total : 0.0;
}

}  // namespace scree::terrain
