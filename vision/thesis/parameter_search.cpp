#include "vision/thesis/parameter_search.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "vision/data/metrics.h"
#include "vision/thesis/thesis_method.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace scree::vision {
namespace {

using Change = std::function<void(ThesisOptions&)>;
using Axis = std::vector<Change>;  // the candidate values of one parameter

template <class Value>
Axis axis_of(Value ThesisOptions::*member, std::initializer_list<Value> values) {
    Axis axis;
    for (const Value value : values)
        axis.emplace_back([member, value](ThesisOptions& o) { o.*member = value; });
    return axis;
}

// The parameters that decide most come first.
std::vector<Axis> axes() {
    using O = ThesisOptions;
    return {axis_of(&O::bright_share, {0.04, 0.07, 0.1, 0.15, 0.2, 0.25}),
            axis_of(&O::least_area, {30.0, 60.0, 120.0, 200.0, 300.0}),
            axis_of(&O::order, {VisitOrder::RowMajor, VisitOrder::DeepestFirst}),
            axis_of(&O::change, {ChangeMode::Any, ChangeMode::Pair, ChangeMode::Abs}),
            axis_of(&O::offset, {1, 2, 3, 4}),
            axis_of(&O::median_kernel, {3, 5, 7, 9}),
            axis_of(&O::inset, {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}),
            axis_of(&O::low_share, {0.2, 1.0 / 3.0, 0.5, 0.7}),
            axis_of(&O::link_reach, {3, 5, 8, 12}),
            axis_of(&O::least_component, {8, 16, 32, 64}),
            axis_of(&O::least_retained_share, {0.3, 0.5, 0.7, 0.8}),
            axis_of(&O::cosine_factor, {0.5, 0.58, 0.65, 0.75}),
            axis_of(&O::sine_factor, {0.35, 0.5, 0.65}),
            axis_of(&O::greatest_radius, {0.1, 0.15, 0.25, 0.4}),
            axis_of(&O::greatest_overlap, {0.1, 0.2, 0.3})};
}

struct Split {
    std::vector<LabelledPicture> train;
    std::vector<LabelledPicture> test;
};

Split split_pictures(std::span<const LabelledPicture> pictures, const SearchOptions& options) {
    std::vector<std::size_t> order(pictures.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    Rng rng({.seed = options.seed, .stream = 31});
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[rng.below(i)]);
    const auto wanted = static_cast<std::size_t>(
        std::lround(options.test_share * static_cast<double>(pictures.size())));
    const std::size_t n_test = std::clamp<std::size_t>(wanted, 1, pictures.size() - 1);
    Split split;
    for (std::size_t i = 0; i < order.size(); ++i)
        (i < n_test ? split.test : split.train).push_back(pictures[order[i]]);
    return split;
}

double picture_score(const LabelledPicture& picture, const ThesisOptions& options) {
    const ThesisResult found = find_thesis_rocks(picture.photo, options);
    std::vector<Outline> outlines;
    for (const Rock& rock : found.rocks)
        outlines.push_back(rock.outline);
    if (outlines.size() > 65535)
        outlines.resize(65535);
    const LabelMap labels = paint_labels(outlines, picture.photo.width(), picture.photo.height());
    return score_labels(labels, picture.labels).ap50;
}

}  // namespace

double thesis_score(std::span<const LabelledPicture> pictures, const ThesisOptions& options) {
    std::vector<double> scores(pictures.size());
    parallel_for_each_index(0, pictures.size(), 1, [&](std::size_t i) {
        scores[i] = picture_score(pictures[i], options);
    });
    return std::accumulate(scores.begin(), scores.end(), 0.0) /
           static_cast<double>(std::max<std::size_t>(1, scores.size()));
}

SearchReport search_parameters(std::span<const LabelledPicture> pictures,
                               const ThesisOptions& start, const SearchOptions& options) {
    check(options);
    check_thesis(start);
    if (pictures.size() < 2)
        fail<InvalidInput>("the search has ", pictures.size(),
                           " pictures, it needs at least two: one to learn from, one to test on");
    const Split split = split_pictures(pictures, options);
    SearchReport report;
    report.best = start;
    report.start_train_score = thesis_score(split.train, start);
    report.best_train_score = report.start_train_score;
    report.n_evaluations = 1;
    bool improved = true;
    for (int sweep = 0; sweep < options.sweeps && improved; ++sweep) {
        improved = false;
        for (const Axis& axis : axes()) {
            const ThesisOptions base = report.best;
            for (const Change& change : axis) {
                if (report.n_evaluations >= options.most_evaluations)
                    break;
                ThesisOptions candidate = base;
                change(candidate);
                const double score = thesis_score(split.train, candidate);
                ++report.n_evaluations;
                if (score > report.best_train_score) {
                    report.best_train_score = score;
                    report.best = candidate;
                    improved = true;
                }
            }
        }
    }
    report.start_test_score = thesis_score(split.test, start);
    report.best_test_score = thesis_score(split.test, report.best);
    return report;
}

}  // namespace scree::vision
