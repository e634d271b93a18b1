#pragma once

#include "vision/outline.h"

#include <array>
#include <vector>

namespace scree::vision {

inline constexpr int kMostHarmonics = 24;

/// A generalised ellipsoid's outline: centre, and the logarithm of the radius as a Fourier series
/// a0 + sum over k of (a_k cos k phi + b_k sin k phi). The logarithm keeps the radius positive.
struct Shape {
    glm::dvec2 centre{0.0};
    int n_harmonics = 0;
    std::array<double, 2 * kMostHarmonics + 1> coefficients{};  ///< a0, a1, b1, a2, b2 ...

    int n_coefficients() const { return 2 * n_harmonics + 1; }
};

/// Radius and its derivative by the azimuth.
struct RadiusSlope {
    double radius = 0.0;
    double slope = 0.0;
};

/// 1, cos phi, sin phi, cos 2 phi ... up to the shape's order, into `basis`.
void fourier_basis(double cosine, double sine, int n_harmonics, double* basis);

/// Radius at the azimuth that `basis` was made for.
RadiusSlope radius_slope(const Shape& shape, const double* basis);

/// Harmonics for a rock of this mean radius: few for pebbles, so that they cannot follow noise.
int harmonics_for(double radius_px);

/// The outline's series about its own centre.
Shape shape_of(const Outline& outline, int n_harmonics);

/// Sample the series at every degree into the radii; the other members stay.
void sample_shape(const Shape& shape, Outline& outline);

/// Geometric mean of the radii.
double mean_radius(const Outline& outline);

}  // namespace scree::vision
