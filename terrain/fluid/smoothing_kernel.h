#pragma once

#include <cmath>
#include <numbers>

namespace scree::terrain {

/// The kernels of `mesh-erosion.md` 8.2 over a smoothing radius h, and what a wall adds.
struct SmoothingKernel {
    float h = 0.2F;
    float scale6 = 0.0F;   ///< 315 / (64 pi h^9)
    float scale_s = 0.0F;  ///< -45 / (pi h^6)

    explicit SmoothingKernel(double radius)
        : h(static_cast<float>(radius)),
          scale6(static_cast<float>(315.0 / (64.0 * std::numbers::pi * std::pow(radius, 9)))),
          scale_s(static_cast<float>(-45.0 / (std::numbers::pi * std::pow(radius, 6)))) {}

    /// W6 at a squared distance below h^2.
    float density(float squared) const {
        const float rest = h * h - squared;
        return scale6 * rest * rest * rest;
    }
    /// Length of the gradient of Ws, negative: it points towards the centre.
    float slope(float distance) const {
        const float rest = h - distance;
        return scale_s * rest * rest;
    }

    /// Integral of W6 over the half space that begins `distance` away, per unit of density:
    /// 315/256 times the integral of (1 - t^2)^4 from distance/h to 1.
    float wall(float distance) const {
        const float q = std::fmin(1.0F, std::fmax(0.0F, distance / h));
        const float q2 = q * q;
        const float sum =
            q * (1.0F + q2 * (-4.0F / 3.0F + q2 * (6.0F / 5.0F + q2 * (-4.0F / 7.0F + q2 / 9.0F))));
        return 315.0F / 256.0F * (128.0F / 315.0F - sum);
    }
    /// Its derivative by the distance.
    float wall_slope(float distance) const {
        const float q = std::fmin(1.0F, std::fmax(0.0F, distance / h));
        const float rest = 1.0F - q * q;
        return -315.0F / 256.0F * rest * rest * rest * rest / h;
    }
};

}  // namespace scree::terrain
