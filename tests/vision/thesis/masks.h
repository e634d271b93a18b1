#pragma once

#include "base/raster.h"
#include "testdata/synthetic_photo.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::test {

/// Draw a digital line, 8-connected.
inline void draw(Mask& mask, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 way = to - from;
    const int steps = static_cast<int>(std::ceil(2.0 * std::max(std::abs(way.x), std::abs(way.y))));
    for (int i = 0; i <= steps; ++i) {
        const glm::dvec2 p = from + way * (static_cast<double>(i) / std::max(1, steps));
        const int x = static_cast<int>(std::floor(p.x));
        const int y = static_cast<int>(std::floor(p.y));
        if (mask.contains(x, y))
            mask(x, y) = 1;
    }
}

/// Draw the closed curve of a radius function, leaving out azimuths in [gap_from, gap_to) degrees.
inline void draw_curve(Mask& mask, glm::dvec2 centre, const std::function<double(double)>& radius,
                       double gap_from = 0.0, double gap_to = 0.0) {
    const auto at = [&](double degrees) {
        const double a = degrees * std::numbers::pi / 180.0;
        return centre + radius(a) * glm::dvec2(std::cos(a), std::sin(a));
    };
    for (int k = 0; k < 720; ++k) {
        const double d = 0.5 * k;
        if (d < gap_from || d >= gap_to)
            draw(mask, at(d), at(d + 0.5));
    }
}

inline void draw_circle(Mask& mask, glm::dvec2 centre, double radius) {
    draw_curve(mask, centre, [radius](double) { return radius; });
}

/// Border pixels of a label map: a right or lower neighbour has another label.
inline Mask borders(const LabelMap& labels) {
    Mask result(labels.width(), labels.height());
    for (int y = 0; y + 1 < labels.height(); ++y)
        for (int x = 0; x + 1 < labels.width(); ++x)
            result(x, y) =
                labels(x, y) != labels(x + 1, y) || labels(x, y) != labels(x, y + 1) ? 1 : 0;
    return result;
}

inline bool any_within(const Mask& mask, int x, int y, int distance) {
    for (int v = y - distance; v <= y + distance; ++v)
        for (int u = x - distance; u <= x + distance; ++u)
            if (mask.contains(u, v) && mask(u, v) != 0)
                return true;
    return false;
}

/// How a mask of edges compares with the truth.
struct MaskQuality {
    double recall = 0.0;    ///< Share of border pixels with an edge within 2 px.
    double interior = 0.0;  ///< Share of rock pixels deeper than 5 px that are edges.
};

inline MaskQuality mask_quality(const Mask& edges, const LabelMap& labels) {
    const Mask truth = borders(labels);
    double n_border = 0.0;
    double n_hit = 0.0;
    double n_deep = 0.0;
    double n_wrong = 0.0;
    for (int y = 6; y + 6 < labels.height(); ++y)
        for (int x = 6; x + 6 < labels.width(); ++x) {
            if (truth(x, y) != 0) {
                n_border += 1.0;
                n_hit += any_within(edges, x, y, 2) ? 1.0 : 0.0;
            } else if (labels(x, y) != 0 && !any_within(truth, x, y, 5)) {
                n_deep += 1.0;
                n_wrong += edges(x, y) != 0 ? 1.0 : 0.0;
            }
        }
    return {n_border > 0.0 ? n_hit / n_border : 0.0, n_deep > 0.0 ? n_wrong / n_deep : 0.0};
}

/// Rounded rocks in dark gaps, little texture: a mask is easily made of it.
inline SyntheticOptions suited_picture(std::uint64_t seed) {
    SyntheticOptions o;
    o.width = 320;
    o.height = 240;
    o.n_rocks = 40;
    o.least_diameter = 25;
    o.median_diameter = 42;
    o.greatest_diameter = 80;
    o.size_spread = 0.4;
    o.gap = 6;
    o.growth = 0;
    o.texture = 0.05;
    o.colour = 0.2;
    o.light_elevation = 80;
    o.seed = seed;
    return o;
}

/// A picture suited to the whole method: packed rocks, dark crevices, nothing else between them.
inline SyntheticOptions packed_picture(std::uint64_t seed) {
    SyntheticOptions o = suited_picture(seed);
    o.layout = Layout::Cells;
    o.n_rocks = 400;
    o.median_diameter = 30;
    o.gap = 3;
    o.grain = 0;
    o.noise = 0.004;
    return o;
}

}  // namespace scree::test
