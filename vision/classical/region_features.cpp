#include "vision/classical/region_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::vision {
namespace {

struct Shape {
    double ellipse = 1;     // area over that of the ellipse with the same moments: 1 if it is one
    double elongation = 1;  // ratio of the ellipse's axes
};

Shape shape_of(const AreaStats& s) {
    const double n = s.area;
    // A pixel is a square, not a point: 1/12 of its side's square on each axis.
    const double xx = s.xx / n - s.x * s.x / (n * n) + 1.0 / 12;
    const double yy = s.yy / n - s.y * s.y / (n * n) + 1.0 / 12;
    const double xy = s.xy / n - s.x * s.y / (n * n);
    const double det = std::max(1e-6, xx * yy - xy * xy);
    const double half = 0.5 * (xx + yy);
    const double root = std::sqrt(std::max(0.0, half * half - det));
    return {n / (4 * std::numbers::pi * std::sqrt(det)),
            std::sqrt((half + root) / std::max(1e-6, half - root))};
}

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

}  // namespace

std::array<float, kRegionFeatures> region_features(const MergeTree& tree, int index) {
    const auto at = [&](int i) -> const RegionNode& {
        return tree.nodes[static_cast<std::size_t>(i)];
    };
    const RegionNode& r = at(index);
    const AreaStats& p = r.pixels;
    const Shape shape = shape_of(p);
    const bool leaf = r.left < 0;
    const RegionNode& small =
        leaf ? r : at(at(r.left).pixels.area < at(r.right).pixels.area ? r.left : r.right);
    const RegionNode& large =
        leaf ? r : at(at(r.left).pixels.area < at(r.right).pixels.area ? r.right : r.left);
    const bool root = r.parent < 0;
    const RegionNode& parent = root ? r : at(r.parent);
    const RegionNode& sibling = root ? r : at(parent.left == index ? parent.right : parent.left);
    const double length = r.outer.length + r.frame;
    const double mean_luma = p.luma / p.area;
    const double inner = r.removed.length;
    const std::array<double, kRegionFeatures> values = {
        std::log(p.area),
        r.outer.mean(),
        share(r.outer.weak, r.outer.length),
        share(r.outer.middling, r.outer.length),
        share(r.open.length, r.outer.length),
        r.open.mean(),
        share(r.frame, length),
        r.strongest,
        leaf ? 0.0 : r.height,
        share(r.removed.sum, std::sqrt(p.area)),
        share(r.removed.sum, inner),
        share(inner - r.removed.middling, std::sqrt(p.area)),
        p.inside / p.area,
        p.boundary / p.area,
        p.distance / p.area,
        p.deepest,
        shape.ellipse,
        std::log(shape.elongation),
        length / std::sqrt(4 * std::numbers::pi * p.area),
        root ? 1.0 : parent.height,
        root ? 1.0 : parent.height - r.strongest,
        std::log(parent.pixels.area / p.area),
        std::log(large.pixels.area / p.area),
        small.pixels.deepest,
        large.pixels.deepest,
        share(small.pixels.inside, small.pixels.area),
        std::sqrt(std::max(0.0, p.luma2 / p.area - mean_luma * mean_luma)),
        share(large.pixels.luma, large.pixels.area) - share(small.pixels.luma, small.pixels.area),
        share(parent.pixels.luma, parent.pixels.area) - mean_luma,
        shape_of(parent.pixels).ellipse,
        share(r.outer.depth, r.outer.length),
        share(r.removed.depth, inner),
        r.pass,
        leaf ? 0.0 : std::min(small.pixels.deepest, large.pixels.deepest) - r.pass,
        r.split,
        std::log(static_cast<double>(r.peaks)),
        root ? 1.0 : std::min(p.deepest, sibling.pixels.deepest) - parent.pass,
        root ? 0.0 : parent.pass,
        root ? 0.0 : parent.split,
        std::log(sibling.pixels.area / p.area),
        share(sibling.pixels.inside, sibling.pixels.area),
        sibling.outer.mean(),
    };
    std::array<float, kRegionFeatures> features;
    std::transform(values.begin(), values.end(), features.begin(),
                   [](double v) { return static_cast<float>(v); });
    return features;
}

}  // namespace scree::vision
