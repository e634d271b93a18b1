#include "meshing/rocks/generalised_ellipsoid.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDifference = 1e-5;  // radians

bool positive(double value) {
    return value > 0.0 && std::isfinite(value);
}

AngleFunction constant(double value) {
    return [value](double, double) { return value; };
}

AngleFunction of_azimuth(AzimuthFunction function) {
    return [function = std::move(function)](double azimuth, double) { return function(azimuth); };
}

// Whether the slopes on both sides of a place agree; a place with a jump has no slope at all.
bool smooth_at(const AzimuthFunction& along, double at, double tolerance) {
    const double here = along(at);
    const double before = (here - along(at - kDifference)) / kDifference;
    const double after = (along(at + kDifference) - here) / kDifference;
    return std::abs(after - before) <= tolerance;
}

// The checks at one place of the grid.
class Checker {
public:
    Checker(const GeneralisedEllipsoid& surface, const RegularityOptions& options)
        : surface_(surface), options_(options), unit_(mean_semi_axis()) {}

    RegularityReport run() {
        report_ = {true, true, true, true, true, true, true, true};
        for (int k = 0; k < options_.elevations; ++k) {
            const double elevation = kPi * ((k + 0.5) / options_.elevations - 0.5);
            for (int s = 0; s < options_.azimuths; ++s)
                look_at(2.0 * kPi * (s + 0.5) / options_.azimuths, elevation);
            look_at_seam(elevation);
        }
        for (int s = 0; s < options_.azimuths; ++s) {
            const double azimuth = 2.0 * kPi * (s + 0.5) / options_.azimuths;
            look_at_poles(azimuth);
            report_.turning_equator &= equator_turns_at(azimuth);
        }
        return report_;
    }

private:
    double mean_semi_axis() const {
        const double sum = std::abs(surface_.f(0.0, 0.0)) + std::abs(surface_.h(0.0, 0.0)) +
                           std::abs(surface_.g(0.5 * kPi, 0.0));
        return std::isfinite(sum) && sum > 0.0 ? sum / 3.0 : 1.0;
    }

    void look_at(double azimuth, double elevation) {
        const double f = surface_.f(azimuth, elevation);
        const double g = surface_.g(azimuth, elevation);
        const double h = surface_.h(azimuth, elevation);
        report_.positive_radii &= positive(f) && positive(g);
        report_.positive_depth &= positive(h);
        report_.radial &= std::abs(f - g) <= options_.tolerance * unit_ &&
                          std::abs(f - h) <= options_.tolerance * unit_;
        report_.oriented &= oriented_at(azimuth, elevation);
        for (const AngleFunction* function : {&surface_.f, &surface_.g, &surface_.h}) {
            const auto round = [&](double a) { return (*function)(a, elevation); };
            const auto up = [&](double e) { return (*function)(azimuth, e); };
            report_.differentiable &= smooth_at(round, azimuth, slope_tolerance()) &&
                                      smooth_at(up, elevation, slope_tolerance());
        }
    }

    void look_at_seam(double elevation) {
        for (const AngleFunction* function : {&surface_.f, &surface_.g, &surface_.h}) {
            const AngleFunction& value = *function;
            const double first = value(0.0, elevation);
            const double last = value(2.0 * kPi, elevation);
            report_.periodic &= std::abs(first - last) <= options_.tolerance * unit_;
            const double after = (value(kDifference, elevation) - first) / kDifference;
            const double before = (last - value(2.0 * kPi - kDifference, elevation)) / kDifference;
            report_.differentiable &= std::abs(after - before) <= slope_tolerance();
        }
    }

    void look_at_poles(double azimuth) {
        for (const double side : {-1.0, 1.0}) {
            const double pole = side * 0.5 * kPi;
            const double here = surface_.h(azimuth, pole);
            const double up = (here - surface_.h(azimuth, pole - side * kDifference)) / kDifference;
            const double round = (surface_.h(azimuth + kDifference, pole) - here) / kDifference;
            report_.flat_poles &= std::hypot(up, round) <= slope_tolerance();
        }
    }

    // Condition 5; the slope of f and g by central differences.
    bool equator_turns_at(double azimuth) const {
        const auto slope = [&](const AngleFunction& value) {
            return (value(azimuth + kDifference, 0.0) - value(azimuth - kDifference, 0.0)) /
                   (2.0 * kDifference);
        };
        const double f = surface_.f(azimuth, 0.0);
        const double g = surface_.g(azimuth, 0.0);
        const double twist = f * slope(surface_.g) - g * slope(surface_.f);
        return f * g + twist * std::sin(azimuth) * std::cos(azimuth) > 0.0;
    }

    // Condition 6.
    bool oriented_at(double azimuth, double elevation) const {
        const auto at = [&](double a, double e) {
            return point_on(surface_, a, e) - surface_.centre;
        };
        const glm::dvec3 up =
            at(azimuth, elevation + kDifference) - at(azimuth, elevation - kDifference);
        const glm::dvec3 round =
            at(azimuth + kDifference, elevation) - at(azimuth - kDifference, elevation);
        return glm::dot(at(azimuth, elevation), glm::cross(up, round)) > 0.0;
    }

    // One-sided differences of smooth functions differ by curvature times the step.
    double slope_tolerance() const {
        return unit_ * (options_.tolerance + kCurvature * kDifference);
    }

    static constexpr double kCurvature = 100.0;  // of what still counts as smooth, over the size

    const GeneralisedEllipsoid& surface_;
    RegularityOptions options_;
    double unit_;
    RegularityReport report_;
};

}  // namespace

GeneralisedEllipsoid ellipsoid(glm::dvec3 semi_axes, glm::dvec3 centre) {
    if (!positive(semi_axes.x) || !positive(semi_axes.y) || !positive(semi_axes.z))
        fail<InvalidInput>("the semi-axes are (", semi_axes.x, ", ", semi_axes.y, ", ", semi_axes.z,
                           "), all must be positive");
    return {constant(semi_axes.x), constant(semi_axes.y), constant(semi_axes.z), centre};
}

GeneralisedEllipsoid ellipsoid_by_azimuth(AzimuthFunction f, AzimuthFunction h, AzimuthFunction g,
                                          glm::dvec3 centre) {
    return {of_azimuth(std::move(f)), of_azimuth(std::move(h)), of_azimuth(std::move(g)), centre};
}

GeneralisedEllipsoid ellipsoid_from_radii(std::span<const float> radii, double depth,
                                          glm::dvec3 centre) {
    if (radii.size() < 3)
        fail<InvalidInput>("a radius function needs at least 3 radii, got ", radii.size());
    for (const float r : radii)
        if (!positive(static_cast<double>(r)))
            fail<InvalidInput>("a radius is ", r, ", all must be positive");
    if (!positive(depth))
        fail<InvalidInput>("the depth is ", depth, ", must be positive");
    AngleFunction radius = [copy = std::vector<float>(radii.begin(), radii.end())](double azimuth,
                                                                                   double) {
        const double turns = azimuth / (2.0 * kPi);
        const double at = (turns - std::floor(turns)) * static_cast<double>(copy.size());
        const double whole = std::floor(at);
        const auto k = static_cast<std::size_t>(whole) % copy.size();
        const double here = static_cast<double>(copy[k]);
        const double next = static_cast<double>(copy[(k + 1) % copy.size()]);
        return here + (at - whole) * (next - here);
    };
    return {radius, constant(depth), radius, centre};
}

glm::dvec3 point_on(const GeneralisedEllipsoid& surface, double azimuth, double elevation) {
    const double out = std::cos(elevation);
    return surface.centre + glm::dvec3(surface.f(azimuth, elevation) * std::cos(azimuth) * out,
                                       surface.h(azimuth, elevation) * std::sin(elevation),
                                       surface.g(azimuth, elevation) * std::sin(azimuth) * out);
}

glm::dvec2 silhouette_point(const GeneralisedEllipsoid& surface, double azimuth) {
    const glm::dvec3 point = point_on(surface, azimuth, 0.0);
    return {point.x, point.z};
}

glm::dvec3 normal_on(const GeneralisedEllipsoid& surface, double azimuth, double elevation) {
    const glm::dvec3 up = point_on(surface, azimuth, elevation + kDifference) -
                          point_on(surface, azimuth, elevation - kDifference);
    const glm::dvec3 round = point_on(surface, azimuth + kDifference, elevation) -
                             point_on(surface, azimuth - kDifference, elevation);
    const glm::dvec3 normal = glm::cross(up, round);
    const double length = glm::length(normal);
    const bool pole = std::abs(elevation) > 0.5 * kPi - kDifference;
    return pole || !(length > 0.0) ? glm::dvec3(0.0, elevation < 0.0 ? -1.0 : 1.0, 0.0)
                                   : normal / length;
}

RegularityReport check_regularity(const GeneralisedEllipsoid& surface,
                                  const RegularityOptions& options) {
    if (options.azimuths < 8 || options.elevations < 4)
        fail<InvalidOption>("the grid is ", options.azimuths, " x ", options.elevations,
                            ", must be at least 8 x 4");
    if (!(options.tolerance > 0.0))
        fail<InvalidOption>("tolerance is ", options.tolerance, ", must be over 0");
    return Checker(surface, options).run();
}

}  // namespace scree::meshing
