#include "vision/classical/outline_features.h"

#include "vision/classical/region_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace scree::vision {
namespace {

// Values along one ray of an outline.
struct Ray {
    double border = 0;    // strongest boundary within a pixel and a half of the outline
    double inner = 0;     // strongest boundary well within
    double within = 0;    // inside just within
    double beyond = 0;    // inside just beyond
    double mismatch = 0;  // of the distance channel with a cone
    double hollow = 0;    // boundary just beyond, between this rock and the next
};

float sample(const FloatRaster& channel, glm::dvec2 p) {
    const int x = static_cast<int>(std::clamp(p.x, 0.0, channel.width() - 1.0));
    const int y = static_cast<int>(std::clamp(p.y, 0.0, channel.height() - 1.0));
    return channel(x, y);
}

Ray look_along(const Outline& o, const EdgeField& field, int degree) {
    const glm::dvec2 out = border_point(o, degree) - o.centre;
    const double r = o.radii[static_cast<std::size_t>(degree)];
    const auto at = [&](const FloatRaster& channel, double radius) -> double {
        return sample(channel, o.centre + out * (radius / r));
    };
    Ray ray;
    for (const double step : {-1.5, -0.75, 0.0, 0.75, 1.5})
        ray.border = std::max(ray.border, at(field.boundary, r + step));
    for (const double share : {0.3, 0.5, 0.7})
        ray.inner = std::max(ray.inner, at(field.boundary, share * r));
    const double margin = std::clamp(0.15 * r, 1.5, 4.0);
    ray.within = at(field.inside, r - margin);
    ray.beyond = at(field.inside, r + margin);
    ray.hollow = at(field.boundary, r + margin);
    for (const double share : {0.2, 0.5, 0.8})
        ray.mismatch += std::abs(at(field.distance, share * r) - (1 - share)) / 3;
    return ray;
}

double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// Longest run of rays, as a share of all, where the border is weak.
double longest_gap(const std::vector<double>& border) {
    std::size_t run = 0, longest = 0;
    for (std::size_t i = 0; i < 2 * border.size(); ++i) {
        run = border[i % border.size()] < 0.35 ? run + 1 : 0;
        longest = std::max(longest, std::min(run, border.size()));
    }
    return static_cast<double>(longest) / static_cast<double>(border.size());
}

// Share of the convex hull that the outline fills, from chords: 1 for a convex outline.
double convexity(const Outline& o) {
    double filled = 0, hull = 0;
    for (int k = 0; k < kRadii; k += 6) {
        const auto radius = [&](int degree) {
            return static_cast<double>(
                o.radii[static_cast<std::size_t>((degree + kRadii) % kRadii)]);
        };
        double reach = radius(k);
        for (const int step : {12, 24, 42, 66}) {  // where the chord between two neighbours crosses
            const double a = radius(k - step), b = radius(k + step);
            const double angle = step * std::numbers::pi / 180;
            reach = std::max(reach, a * b * std::sin(2 * angle) / ((a + b) * std::sin(angle)));
        }
        filled += radius(k) * radius(k);
        hull += reach * reach;
    }
    return filled / hull;
}

double variation(const Outline& o) {
    double sum = 0, squares = 0;
    for (const float r : o.radii) {
        sum += r;
        squares += static_cast<double>(r) * r;
    }
    const double mean = sum / kRadii;
    return std::sqrt(std::max(0.0, squares / kRadii - mean * mean)) / mean;
}

}  // namespace

std::array<float, kOutlineFeatures> outline_features(const Outline& outline,
                                                     const EdgeField& field) {
    const double radius = 0.5 * equivalent_diameter(outline);
    std::vector<double> border, inner;
    Ray mean;
    for (int k = 0; k < kRadii; k += draft_stride(radius)) {
        const Ray ray = look_along(outline, field, k);
        border.push_back(ray.border);
        inner.push_back(ray.inner);
        mean.border += ray.border;
        mean.inner += ray.inner;
        mean.within += ray.within;
        mean.beyond += ray.beyond;
        mean.hollow += ray.hollow;
        mean.mismatch += ray.mismatch;
    }
    const auto n = static_cast<double>(border.size());
    const double gap = longest_gap(border);
    const std::array<double, kOutlineFeatures> values = {
        mean.border / n,
        quantile(border, 0.1),
        quantile(border, 0.25),
        quantile(border, 0.5),
        gap,
        mean.inner / n,
        quantile(inner, 0.9),
        mean.within / n,
        mean.beyond / n,
        mean.hollow / n,
        mean.mismatch / n,
        convexity(outline),
        variation(outline),
        sample(field.distance, outline.centre),
    };
    std::array<float, kOutlineFeatures> features;
    std::transform(values.begin(), values.end(), features.begin(),
                   [](double v) { return static_cast<float>(v); });
    return features;
}

}  // namespace scree::vision
