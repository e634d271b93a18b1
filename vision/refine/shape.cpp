#include "vision/refine/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::vision {
namespace {

struct Circle {
    std::array<double, kRadii> cosine{};
    std::array<double, kRadii> sine{};
};

const Circle& circle() {
    static const Circle table = [] {
        Circle made;
        for (std::size_t k = 0; k < kRadii; ++k) {
            const double azimuth = static_cast<double>(k) * std::numbers::pi / 180.0;
            made.cosine[k] = std::cos(azimuth);
            made.sine[k] = std::sin(azimuth);
        }
        return made;
    }();
    return table;
}

}  // namespace

void fourier_basis(double cosine, double sine, int n_harmonics, double* basis) {
    basis[0] = 1.0;
    double c = 1.0;
    double s = 0.0;
    for (int k = 1; k <= n_harmonics; ++k) {
        const double next = c * cosine - s * sine;
        s = s * cosine + c * sine;
        c = next;
        basis[2 * k - 1] = c;
        basis[2 * k] = s;
    }
}

RadiusSlope radius_slope(const Shape& shape, const double* basis) {
    double value = shape.coefficients[0];
    double slope = 0.0;
    for (int k = 1; k <= shape.n_harmonics; ++k) {
        const auto i = static_cast<std::size_t>(2 * k);
        const double a = shape.coefficients[i - 1];
        const double b = shape.coefficients[i];
        value += a * basis[i - 1] + b * basis[i];
        slope += k * (b * basis[i - 1] - a * basis[i]);
    }
    const double radius = std::exp(value);
    return {radius, radius * slope};
}

int harmonics_for(double radius_px) {
    return std::clamp(static_cast<int>(std::lround(2.0 + 0.35 * radius_px)), 3, kMostHarmonics);
}

Shape shape_of(const Outline& outline, int n_harmonics) {
    Shape shape;
    shape.centre = outline.centre;
    shape.n_harmonics = n_harmonics;
    std::array<double, 2 * kMostHarmonics + 1> basis{};
    for (std::size_t k = 0; k < kRadii; ++k) {
        fourier_basis(circle().cosine[k], circle().sine[k], n_harmonics, basis.data());
        const double value = std::log(static_cast<double>(outline.radii[k]));
        for (std::size_t i = 0; i < static_cast<std::size_t>(shape.n_coefficients()); ++i)
            shape.coefficients[i] += (i == 0 ? 1.0 : 2.0) / kRadii * value * basis[i];
    }
    return shape;
}

void sample_shape(const Shape& shape, Outline& outline) {
    outline.centre = shape.centre;
    std::array<double, 2 * kMostHarmonics + 1> basis{};
    for (std::size_t k = 0; k < kRadii; ++k) {
        fourier_basis(circle().cosine[k], circle().sine[k], shape.n_harmonics, basis.data());
        outline.radii[k] = static_cast<float>(radius_slope(shape, basis.data()).radius);
    }
}

double mean_radius(const Outline& outline) {
    double sum = 0.0;
    for (const float radius : outline.radii)
        sum += std::log(static_cast<double>(radius));
    return std::exp(sum / kRadii);
}

}  // namespace scree::vision
