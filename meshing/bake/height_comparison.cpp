#include "meshing/bake/height_comparison.h"

#include "base/error.h"
#include "base/options.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace scree::meshing {
namespace {

void check_rasters(const FloatRaster& heights, const FloatRaster& truth, const LabelMap& labels) {
    const auto same = [&](const auto& other) {
        return other.width() == heights.width() && other.height() == heights.height();
    };
    if (heights.empty() || !same(truth) || !same(labels))
        fail<InvalidInput>("heights to compare need one size for all three rasters, got ",
                           heights.width(), " x ", heights.height(), ", ", truth.width(), " x ",
                           truth.height(), " and ", labels.width(), " x ", labels.height());
    const auto finite = [](float h) { return std::isfinite(h); };
    if (!std::all_of(heights.begin(), heights.end(), finite) ||
        !std::all_of(truth.begin(), truth.end(), finite))
        fail<InvalidInput>("the heights hold a value that is no number");
}

double mean_of(const FloatRaster& values) {
    double sum = 0.0;
    for (const float v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

double correlation(const FloatRaster& a, const FloatRaster& b) {
    const double mean_a = mean_of(a);
    const double mean_b = mean_of(b);
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double da = a.data()[i] - mean_a;
        const double db = b.data()[i] - mean_b;
        aa += da * da;
        bb += db * db;
        ab += da * db;
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

// Pixels of a rock with nothing but that rock within `border` pixels along rows and columns.
Mask interior(const LabelMap& labels, int border) {
    Mask mask(labels.width(), labels.height());
    for (int y = border; y < labels.height() - border; ++y)
        for (int x = border; x < labels.width() - border; ++x) {
            const auto label = labels(x, y);
            bool same = label != 0;
            for (int d = 1; same && d <= border; ++d)
                same = labels(x - d, y) == label && labels(x + d, y) == label &&
                       labels(x, y - d) == label && labels(x, y + d) == label;
            mask(x, y) = same ? 1 : 0;
        }
    return mask;
}

FloatRaster blurred_rows(const FloatRaster& source, const std::vector<double>& weights) {
    const int reach = static_cast<int>(weights.size()) - 1;
    FloatRaster out(source.width(), source.height());
    for (int y = 0; y < source.height(); ++y)
        for (int x = 0; x < source.width(); ++x) {
            double sum = weights[0] * source(x, y);
            for (int d = 1; d <= reach; ++d)
                sum += weights[static_cast<std::size_t>(d)] *
                       (static_cast<double>(source(std::max(x - d, 0), y)) +
                        source(std::min(x + d, source.width() - 1), y));
            out(x, y) = static_cast<float>(sum);
        }
    return out;
}

FloatRaster transposed(const FloatRaster& source) {
    FloatRaster out(source.height(), source.width());
    for (int y = 0; y < source.height(); ++y)
        for (int x = 0; x < source.width(); ++x)
            out(y, x) = source(x, y);
    return out;
}

FloatRaster blurred(const FloatRaster& source, double sigma) {
    std::vector<double> weights;
    double sum = 0.0;
    for (int d = 0; d <= static_cast<int>(std::ceil(3.0 * sigma)); ++d) {
        weights.push_back(std::exp(-0.5 * d * d / (sigma * sigma)));
        sum += d == 0 ? weights.back() : 2.0 * weights.back();
    }
    for (double& w : weights)
        w /= sum;
    return transposed(blurred_rows(transposed(blurred_rows(source, weights)), weights));
}

double fine_share(const FloatRaster& heights, const Mask& inside, double sigma) {
    const FloatRaster coarse = blurred(heights, sigma);
    double n = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    double fine = 0.0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (inside.data()[i] == 0)
            continue;
        const double h = heights.data()[i];
        const double rest = h - coarse.data()[i];
        n += 1.0;
        sum += h;
        squares += h * h;
        fine += rest * rest;
    }
    const double variance = n > 0.0 ? squares - sum * sum / n : 0.0;
    return variance > 0.0 ? fine / variance : 0.0;
}

struct Steps {
    double at_borders = 0.0;
    double n_borders = 0.0;
    double inside = 0.0;
    double n_inside = 0.0;

    void add(double step, bool border, bool within) {
        (border ? at_borders : inside) += border || within ? std::abs(step) : 0.0;
        n_borders += border ? 1.0 : 0.0;
        n_inside += !border && within ? 1.0 : 0.0;
    }
};

double border_step(const FloatRaster& heights, const LabelMap& labels, const Mask& inside) {
    Steps steps;
    for (int y = 0; y + 1 < heights.height(); ++y)
        for (int x = 0; x + 1 < heights.width(); ++x) {
            const double h = heights(x, y);
            steps.add(heights(x + 1, y) - h, labels(x + 1, y) != labels(x, y), inside(x, y) != 0);
            steps.add(heights(x, y + 1) - h, labels(x, y + 1) != labels(x, y), inside(x, y) != 0);
        }
    const bool measurable = steps.n_borders > 0.0 && steps.n_inside > 0.0 && steps.inside > 0.0;
    return measurable ? (steps.at_borders / steps.n_borders) / (steps.inside / steps.n_inside)
                      : 0.0;
}

}  // namespace

HeightComparison compare_heights(const FloatRaster& heights, const FloatRaster& truth,
                                 const LabelMap& labels, const HeightComparisonOptions& options) {
    check(options);
    check_rasters(heights, truth, labels);
    const Mask inside = interior(labels, options.border_px);
    HeightComparison result;
    result.correlation = correlation(heights, truth);
    result.fine_inside = fine_share(heights, inside, options.filter_px);
    result.step_at_borders = border_step(heights, labels, inside);
    return result;
}

FloatRaster brightness_as_height(const Photo& photo) {
    FloatRaster heights(photo.width(), photo.height());
    std::transform(photo.begin(), photo.end(), heights.begin(), [](const glm::u8vec3& c) {
        return (0.2126F * static_cast<float>(c.r) + 0.7152F * static_cast<float>(c.g) +
                0.0722F * static_cast<float>(c.b)) /
               255.0F;
    });
    return heights;
}

}  // namespace scree::meshing
