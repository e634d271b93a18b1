#include "vision/classical/region_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace scree::vision {
namespace {

constexpr double kSpikeReach = 0.1;    // half a spike's width, radians
constexpr double kSmoothShare = 0.08;  // least smoothing along the border, of the radius

// How rays are cast: degrees between them and pixels between their samples.
struct RayPlan {
    int stride = 1;
    double step = 0.5;
};

RayPlan plan_rays(double radius, Precision precision) {
    if (precision == Precision::Full)
        return {ray_stride(radius), 0.5};
    return {draft_stride(radius), std::clamp(radius / 24, 0.5, 3.0)};
}

// The pixel of the region with the most room around it, found by growing squares; near `from` on a
// tie.
glm::dvec2 deepest_point(const RegionIndex& index, int region, glm::dvec2 from, double reach) {
    const int x0 = std::max(0, static_cast<int>(from.x - reach));
    const int y0 = std::max(0, static_cast<int>(from.y - reach));
    const int x1 = std::min(index.width() - 1, static_cast<int>(from.x + reach));
    const int y1 = std::min(index.height() - 1, static_cast<int>(from.y + reach));
    Raster<int> room(x1 - x0 + 2, y1 - y0 + 2, 0);  // side of the largest square ending at a pixel
    glm::dvec2 best = from;
    double most = 0, nearest = 0;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            if (!index.holds(region, x, y))
                continue;
            const int u = x - x0 + 1, v = y - y0 + 1;
            room(u, v) = 1 + std::min({room(u - 1, v), room(u, v - 1), room(u - 1, v - 1)});
            const double side = room(u, v);
            const glm::dvec2 middle(x + 1 - 0.5 * side, y + 1 - 0.5 * side);
            const double away = std::hypot(middle.x - from.x, middle.y - from.y);
            if (side > most || (side == most && away < nearest)) {
                most = side;
                nearest = away;
                best = middle;
            }
        }
    return best;
}

// Length of a ray from inside a box to its border.
double length_in_box(const RegionIndex::Box& box, glm::dvec2 centre, glm::dvec2 direction) {
    const glm::dvec2 low(box.x0, box.y0), high(box.x1, box.y1);
    double length = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 2; ++axis)
        if (direction[axis] != 0) {
            const double end = direction[axis] > 0 ? high[axis] : low[axis];
            length = std::min(length, (end - centre[axis]) / direction[axis]);
        }
    return length;
}

// Radius of the sector that has as much area as the region along the ray.
double radius_along(const RegionIndex& index, int region, glm::dvec2 centre, glm::dvec2 direction,
                    double reach, double step) {
    const double end = std::min(reach, length_in_box(index.box(region), centre, direction));
    double moment = 0, pending = 0;
    for (double t = 0.5 * step; t < end; t += step) {
        const int x = static_cast<int>(centre.x + t * direction.x);
        const int y = static_cast<int>(centre.y + t * direction.y);
        if (x < 0 || y < 0 || x >= index.width() || y >= index.height())
            break;
        if (index.holds(region, x, y)) {
            moment += pending + t * step;
            pending = 0;
        } else if (index.is_open(x, y)) {
            pending += t * step;  // a hole if the region goes on behind it
        }
    }
    return std::sqrt(2 * moment);
}

std::vector<double> smoothed(const std::vector<double>& in, double sigma) {
    const int n = static_cast<int>(in.size());
    const int radius = std::min(n / 4, static_cast<int>(std::ceil(2.5 * sigma)));
    if (radius < 1)
        return in;
    std::vector<double> weight;
    for (int k = -radius; k <= radius; ++k)
        weight.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
    const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
    std::vector<double> out(in.size());
    for (int i = 0; i < n; ++i) {
        double sum = 0;
        for (int k = 0; k <= 2 * radius; ++k)
            sum += weight[static_cast<std::size_t>(k)] *
                   in[static_cast<std::size_t>((i + k - radius + n) % n)];
        out[static_cast<std::size_t>(i)] = sum / total;
    }
    return out;
}

// Middle value of every ray's neighbourhood: spikes where a region frays vanish, edges stay.
std::vector<double> despiked(const std::vector<double>& in, int reach) {
    const int n = static_cast<int>(in.size());
    std::vector<double> out(in.size()), window;
    for (int i = 0; i < n; ++i) {
        window.clear();
        for (int k = -reach; k <= reach; ++k)
            window.push_back(in[static_cast<std::size_t>((i + k + n) % n)]);
        std::nth_element(window.begin(), window.begin() + reach, window.end());
        out[static_cast<std::size_t>(i)] = window[static_cast<std::size_t>(reach)];
    }
    return out;
}

}  // namespace

int ray_stride(double radius) {
    int stride = 1;
    for (const int wider : {2, 3, 4, 6})
        if (radius * wider * std::numbers::pi / 180 <= 0.8)
            stride = wider;
    return stride;
}

int draft_stride(double radius) {
    return std::max(6, 3 * ray_stride(radius));
}

Outline region_outline(const RegionIndex& index, const RegionNode& node, int region,
                       double smooth_px, Precision precision) {
    const AreaStats& s = node.pixels;
    Outline outline;
    outline.centre = {s.x / s.area, s.y / s.area};
    const double spread = std::sqrt((s.xx + s.yy) / s.area - outline.centre.x * outline.centre.x -
                                    outline.centre.y * outline.centre.y + 1.0 / 6);
    const double reach = 4 * spread + 4;  // an ellipse ends within 2.83 of it
    const int cx = static_cast<int>(outline.centre.x), cy = static_cast<int>(outline.centre.y);
    if (!index.holds(region, cx, cy))
        outline.centre = deepest_point(index, region, outline.centre, reach);
    outline.touches_border = node.frame > 0;

    const double radius = std::sqrt(s.area / std::numbers::pi);
    const auto [stride, step] = plan_rays(radius, precision);
    std::vector<double> radii;
    for (int k = 0; k < kRadii; k += stride) {
        const double angle = k * std::numbers::pi / 180;
        radii.push_back(radius_along(index, region, outline.centre,
                                     {std::cos(angle), std::sin(angle)}, reach, step));
    }
    const double arc = radius * stride * std::numbers::pi / 180;
    radii = despiked(radii, static_cast<int>(std::lround(kSpikeReach * radius / arc)));
    radii = smoothed(radii, std::max(smooth_px, kSmoothShare * radius) / arc);
    for (std::size_t k = 0; k < kRadii; ++k) {
        const std::size_t at = k / static_cast<std::size_t>(stride);
        const double share = static_cast<double>(k % static_cast<std::size_t>(stride)) / stride;
        const double value = (1 - share) * radii[at] + share * radii[(at + 1) % radii.size()];
        outline.radii[k] = static_cast<float>(std::max(0.5, value));
    }
    return outline;
}

}  // namespace scree::vision
