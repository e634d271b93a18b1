#include "vision/data/metrics.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace scree::vision {
namespace {

constexpr std::size_t kValues = 65536;
constexpr int kThresholds = 9;  // 0.50, 0.55 ... 0.90

struct Overlap {
    std::uint32_t pair = 0;    // label found * 65536 + true label
    std::uint64_t pixels = 0;  // that carry both
};

// Every pair of labels that meets somewhere, once, with its pixels. Runs of equal pairs along a
// row are counted first: there are few rocks in a row and many pixels in a rock.
std::vector<Overlap> overlaps(const LabelMap& found, const LabelMap& truth) {
    std::vector<Overlap> runs;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::uint32_t pair =
            (static_cast<std::uint32_t>(found.data()[i]) << 16) | truth.data()[i];
        if (runs.empty() || runs.back().pair != pair)
            runs.push_back({pair, 0});
        ++runs.back().pixels;
    }
    std::sort(runs.begin(), runs.end(),
              [](const Overlap& a, const Overlap& b) { return a.pair < b.pair; });
    std::vector<Overlap> merged;
    for (const Overlap& run : runs) {
        if (merged.empty() || merged.back().pair != run.pair)
            merged.push_back({run.pair, 0});
        merged.back().pixels += run.pixels;
    }
    return merged;
}

struct Areas {
    std::vector<double> found = std::vector<double>(kValues, 0.0);
    std::vector<double> truth = std::vector<double>(kValues, 0.0);
    double both = 0.0;    // pixels that are a rock in both maps
    double either = 0.0;  // pixels that are a rock in at least one
};

Areas areas_of(const std::vector<Overlap>& table) {
    Areas areas;
    for (const Overlap& overlap : table) {
        const std::uint32_t f = overlap.pair >> 16;
        const std::uint32_t t = overlap.pair & 0xFFFFU;
        const auto pixels = static_cast<double>(overlap.pixels);
        areas.found[f] += pixels;
        areas.truth[t] += pixels;
        areas.both += f > 0 && t > 0 ? pixels : 0.0;
        areas.either += f > 0 || t > 0 ? pixels : 0.0;
    }
    return areas;
}

// Equivalent diameters of the labels in use, ascending.
std::vector<double> diameters(const std::vector<double>& areas) {
    std::vector<double> result;
    for (std::size_t label = 1; label < areas.size(); ++label)
        if (areas[label] > 0.0)
            result.push_back(2.0 * std::sqrt(areas[label] / std::numbers::pi));
    std::sort(result.begin(), result.end());
    return result;
}

double relative_error(const std::vector<double>& found, const std::vector<double>& truth,
                      double q) {
    if (found.empty() || truth.empty())
        return 1.0;
    const double wanted = percentile(truth, q);
    return std::abs(percentile(found, q) - wanted) / wanted;
}

// 0.5 + i * step with the step that is left after rounding 0.55: the thresholds of
// `numpy.arange(0.5, 0.91, 0.05)` to the last bit, for an IoU may be exactly 0.6.
double threshold(int i) {
    const double step = (0.5 + 0.05) - 0.5;
    return 0.5 + i * step;
}

void score_matches(const std::vector<Overlap>& table, const Areas& areas, LabelScore& score) {
    std::array<double, kThresholds> matches{};
    double sum = 0.0;
    for (const Overlap& overlap : table) {
        const std::uint32_t f = overlap.pair >> 16;
        const std::uint32_t t = overlap.pair & 0xFFFFU;
        if (f == 0 || t == 0)
            continue;
        const auto pixels = static_cast<double>(overlap.pixels);
        const double iou = pixels / (areas.found[f] + areas.truth[t] - pixels);
        for (int i = 0; i < kThresholds; ++i)
            matches[static_cast<std::size_t>(i)] += iou > threshold(i) ? 1.0 : 0.0;
        sum += iou > threshold(0) ? iou : 0.0;
    }
    const double n = score.n_truth + score.n_found;
    const auto precision = [&](std::size_t i) {
        return matches[i] / std::max(1.0, n - matches[i]);
    };
    score.true_positives = matches[0];
    score.ap50 = precision(0);
    score.ap75 = precision(5);
    for (std::size_t i = 0; i < kThresholds; ++i)
        score.map += precision(i) / kThresholds;
    score.f1 = 2.0 * matches[0] / std::max(1.0, n);
    score.iou = matches[0] > 0.0 ? sum / matches[0] : 0.0;
}

constexpr double LabelScore::*kFigures[] = {
    &LabelScore::n_truth,   &LabelScore::n_found,  &LabelScore::true_positives,
    &LabelScore::ap50,      &LabelScore::ap75,     &LabelScore::map,
    &LabelScore::f1,        &LabelScore::iou,      &LabelScore::cover,
    &LabelScore::d50_error, &LabelScore::d84_error};

}  // namespace

LabelScore score_labels(const LabelMap& found, const LabelMap& truth) {
    if (found.width() != truth.width() || found.height() != truth.height())
        fail<InvalidInput>("label maps differ in size: ", found.width(), " x ", found.height(),
                           " and ", truth.width(), " x ", truth.height());
    const std::vector<Overlap> table = overlaps(found, truth);
    const Areas areas = areas_of(table);
    const std::vector<double> sizes_found = diameters(areas.found);
    const std::vector<double> sizes_truth = diameters(areas.truth);
    LabelScore score;
    score.n_found = static_cast<double>(sizes_found.size());
    score.n_truth = static_cast<double>(sizes_truth.size());
    score_matches(table, areas, score);
    score.cover = areas.both / std::max(1.0, areas.either);
    score.d50_error = relative_error(sizes_found, sizes_truth, 50);
    score.d84_error = relative_error(sizes_found, sizes_truth, 84);
    return score;
}

LabelScore mean_score(std::span<const LabelScore> scores) {
    if (scores.empty())
        fail<InvalidInput>("there is no score to take the mean of");
    LabelScore mean;
    for (const auto figure : kFigures) {
        for (const LabelScore& score : scores)
            mean.*figure += score.*figure;
        mean.*figure /= static_cast<double>(scores.size());
    }
    return mean;
}

double percentile(std::span<const double> sorted, double q) {
    const double rank = q / 100.0 * static_cast<double>(sorted.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(rank), sorted.size() - 1);
    const auto above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace scree::vision
