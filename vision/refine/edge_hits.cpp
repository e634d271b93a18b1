#include "vision/refine/edge_hits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scree::vision {
namespace {

constexpr double kStep = 0.5;         // px between samples along a ray
constexpr int kMostSamples = 801;     // window of at most 200 px
constexpr double kSide = 1.5;         // px from an edge to where its two sides are compared
constexpr double kInsideShare = 0.5;  // worth of a full drop of `inside` against a full edge
constexpr double kPreference = 0.35;  // worth lost at the end of the window
constexpr double kClear = 5.0;        // weight of a hit for each unit it stands above the profile

struct Profile {
    std::array<double, kMostSamples> worth{};
    int count = 0;
};

double worth_at(const EdgeMaps& maps, glm::dvec2 point, glm::dvec2 direction) {
    double worth = sample(maps.boundary, point);
    if (!maps.inside.empty())
        worth += kInsideShare * (sample(maps.inside, point - kSide * direction) -
                                 sample(maps.inside, point + kSide * direction));
    return worth;
}

// Vertex of the parabola through three samples, in steps from the middle one.
double vertex(double before, double middle, double after) {
    const double bend = before - 2.0 * middle + after;
    return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

void find_hit(const EdgeMaps& maps, glm::dvec2 centre, double window, EdgeHit& hit) {
    const double first = std::max(0.5, hit.start - window);
    const double last = hit.start + window;
    const int n = std::clamp(static_cast<int>((last - first) / kStep) + 1, 3, kMostSamples);
    Profile profile;
    profile.count = n;
    double sum = 0.0;
    std::size_t best = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const double t = first + static_cast<double>(i) * kStep;
        const double raw = worth_at(maps, centre + t * hit.direction, hit.direction);
        const double off = (t - hit.start) / window;
        sum += raw;
        profile.worth[i] = raw - kPreference * off * off;
        if (profile.worth[i] > profile.worth[best])
            best = i;
    }
    const double off = (first + static_cast<double>(best) * kStep - hit.start) / window;
    const double raw = profile.worth[best] + kPreference * off * off;
    const double clear = raw - sum / n;
    double place = first + static_cast<double>(best) * kStep;
    const bool peak = best > 0 && best + 1 < static_cast<std::size_t>(n);
    if (peak)
        place +=
            kStep * vertex(profile.worth[best - 1], profile.worth[best], profile.worth[best + 1]);
    hit.point = centre + place * hit.direction;
    hit.weight = peak ? std::clamp(kClear * clear, 0.0, 1.0) : 0.0;
}

}  // namespace

double sample(const FloatRaster& raster, glm::dvec2 point) {
    const double x = std::clamp(point.x - 0.5, 0.0, raster.width() - 1.0);
    const double y = std::clamp(point.y - 0.5, 0.0, raster.height() - 1.0);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, raster.width() - 1);
    const int y1 = std::min(y0 + 1, raster.height() - 1);
    const double u = x - x0;
    const double v = y - y0;
    const float* upper = raster.row(y0);
    const float* lower = raster.row(y1);
    const double above = upper[x0] + u * (upper[x1] - upper[x0]);
    const double below = lower[x0] + u * (lower[x1] - lower[x0]);
    return above + v * (below - above);
}

std::vector<EdgeHit> edge_hits(const EdgeMaps& maps, const Outline& outline, int n_rays,
                               double window) {
    std::vector<EdgeHit> hits(static_cast<std::size_t>(n_rays));
    const double width = maps.boundary.width();
    const double height = maps.boundary.height();
    const double step = 2.0 * std::numbers::pi / n_rays;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        EdgeHit& hit = hits[i];
        const double azimuth = static_cast<double>(i) * step;
        hit.direction = {std::cos(azimuth), std::sin(azimuth)};
        hit.start = radius_at(outline, azimuth);
        const double slope =
            (radius_at(outline, azimuth + step) - radius_at(outline, azimuth - step)) /
            (2.0 * step);
        hit.obliquity = hit.start / std::hypot(hit.start, slope);
        hit.point = outline.centre + hit.start * hit.direction;
        hit.beyond =
            outline.touches_border && (hit.point.x < 1.5 || hit.point.y < 1.5 ||
                                       hit.point.x > width - 1.5 || hit.point.y > height - 1.5);
        if (!hit.beyond)
            find_hit(maps, outline.centre, window, hit);
    }
    return hits;
}

double edge_support(const EdgeMaps& maps, const Outline& outline, int n_rays) {
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < n_rays; ++i) {
        const double azimuth = 2.0 * std::numbers::pi * i / n_rays;
        const glm::dvec2 point =
            outline.centre +
            radius_at(outline, azimuth) * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
        if (point.x <= 1.5 || point.y <= 1.5 || point.x >= maps.boundary.width() - 1.5 ||
            point.y >= maps.boundary.height() - 1.5)
            continue;
        sum += sample(maps.boundary, point);
        ++n;
    }
    return n > 0 ? sum / n : 0.0;
}

}  // namespace scree::vision
