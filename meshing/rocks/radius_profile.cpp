#include "meshing/rocks/radius_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace scree::meshing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// The radius function and its integral, by position in samples; any real position wraps round.
class PeriodicRadius {
public:
    explicit PeriodicRadius(std::span<const float> radii) : radii_(radii), sum_(radii.size() + 1) {
        for (std::size_t k = 0; k < radii.size(); ++k)
            sum_[k + 1] = sum_[k] + 0.5 * (at_sample(k) + at_sample(k + 1));
    }

    double value(double position) const {
        const Place place = locate(position);
        const double here = at_sample(place.index);
        return here + place.share * (at_sample(place.index + 1) - here);
    }

    double integral(double position) const {  // from sample 0; grows by the total every turn
        const Place place = locate(position);
        const double here = at_sample(place.index);
        const double slope = at_sample(place.index + 1) - here;
        return place.turns * sum_.back() + sum_[place.index] +
               place.share * (here + 0.5 * place.share * slope);
    }

private:
    struct Place {
        double turns;
        std::size_t index;
        double share;
    };

    double at_sample(std::size_t k) const { return radii_[k % radii_.size()]; }

    Place locate(double position) const {
        const auto n = static_cast<double>(radii_.size());
        const double turns = std::floor(position / n);
        const double inside = position - turns * n;
        const double whole = std::floor(inside);
        return {turns, static_cast<std::size_t>(whole) % radii_.size(), inside - whole};
    }

    std::span<const float> radii_;
    std::vector<double> sum_;
};

}  // namespace

RadiusProfile sample_radii(std::span<const float> radii, int n_segments, RadiusSampling sampling) {
    assert(radii.size() >= 3 && n_segments >= 3);
    const PeriodicRadius function(radii);
    const auto n_radii = static_cast<double>(radii.size());
    const double spacing = n_radii / n_segments;  // samples a segment
    const bool averaged = sampling == RadiusSampling::Averaged && spacing > 2.0;
    const double half = std::max(0.5 * spacing, 1.0);  // of the difference and the mean
    const double radians = 2.0 * half * kTurn / n_radii;
    RadiusProfile profile;
    profile.radius.reserve(static_cast<std::size_t>(n_segments));
    profile.slope.reserve(static_cast<std::size_t>(n_segments));
    for (int s = 0; s < n_segments; ++s) {
        const double at = s * spacing;
        const double mean =
            averaged ? (function.integral(at + half) - function.integral(at - half)) / (2.0 * half)
                     : function.value(at);
        profile.radius.push_back(mean);
        profile.slope.push_back((function.value(at + half) - function.value(at - half)) / radians);
    }
    return profile;
}

double equatorial_area(std::span<const float> radii) {
    double sum = 0.0;  // of the mean square over each piece, times 3
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const double a = radii[k];
        const double b = radii[(k + 1) % radii.size()];
        sum += a * a + a * b + b * b;
    }
    return kTurn * sum / (6.0 * static_cast<double>(radii.size()));
}

double ellipsoid_volume(std::span<const float> radii, double depth) {
    return 4.0 / 3.0 * equatorial_area(radii) * depth;
}

}  // namespace scree::meshing
