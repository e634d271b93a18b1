#pragma once

#include <cstdint>

namespace scree::terrain {

/// Gradient noise over the plane, about -1 to 1, smooth, zero at whole coordinates; the same for
/// the same seed everywhere.
double plane_noise(double x, double y, std::uint64_t seed);

/// Octaves of it, each twice as fine and half as high, scaled to about -1 to 1.
double fractal_noise(double x, double y, int octaves, std::uint64_t seed);

}  // namespace scree::terrain
