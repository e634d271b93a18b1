#include "vision/classify/classify_ground.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::vision {

namespace {

// Degrees that a class can lie at: the repose of loose ground, roots, stone.
constexpr std::array<double, kGroundClasses> kSteepest = {34, 40, 38, 90, 60};

Photo working_picture(const Photo& photo, int max_side) {
    const int side = std::max(photo.width(), photo.height());
    if (side <= max_side)
        return photo;
    const double scale = static_cast<double>(max_side) / side;
    const auto scaled = [scale](int length) {
        return std::max(1, static_cast<int>(std::lround(scale * length)));
    };
    Photo small(scaled(photo.width()), scaled(photo.height()));
    const cv::Mat from(photo.height(), photo.width(), CV_8UC3,
                       const_cast<glm::u8vec3*>(photo.data()));  // only read
    cv::Mat to(small.height(), small.width(), CV_8UC3, small.data());
    cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
    return small;
}

// The pixel of a smaller raster that covers a pixel of a larger one.
int scaled_index(int i, int from, int to) {
    return static_cast<int>(static_cast<long long>(i) * to / from);
}

std::vector<ClassScores> scores_of(const GroundModel& model,
                                   const std::vector<GroundFeatures>& features) {
    std::vector<ClassScores> scores(features.size());
    parallel_for_each_index(0, scores.size(), 64, [&](std::size_t i) {
        scores[i] = log_probabilities(model, features[i]);
    });
    return scores;
}

void weigh_slope(const FloatRaster& slope, const Superpixels& pieces, double weight,
                 std::vector<ClassScores>& scores) {
    std::vector<double> sums(scores.size());
    std::vector<double> counts(scores.size());
    for (int y = 0; y < pieces.ids.height(); ++y)
        for (int x = 0; x < pieces.ids.width(); ++x) {
            const auto id = static_cast<std::size_t>(pieces.ids(x, y));
            sums[id] +=
                static_cast<double>(slope(scaled_index(x, pieces.ids.width(), slope.width()),
                                          scaled_index(y, pieces.ids.height(), slope.height())));
            counts[id] += 1.0;
        }
    for (std::size_t i = 0; i < scores.size(); ++i)
        for (std::size_t c = 0; c < kGroundClasses; ++c)
            scores[i][c] -= weight * std::max(0.0, sums[i] / counts[i] - kSteepest[c]);
}

struct Border {
    std::size_t other;
    double share;  // of the piece's border with other pieces
};

std::vector<std::vector<Border>> borders_of(const Superpixels& pieces) {
    std::vector<std::map<std::int32_t, double>> lengths(static_cast<std::size_t>(pieces.count));
    const auto meet = [&](std::int32_t a, std::int32_t b) {
        if (a == b)
            return;
        lengths[static_cast<std::size_t>(a)][b] += 1.0;
        lengths[static_cast<std::size_t>(b)][a] += 1.0;
    };
    for (int y = 0; y < pieces.ids.height(); ++y)
        for (int x = 0; x < pieces.ids.width(); ++x) {
            if (x + 1 < pieces.ids.width())
                meet(pieces.ids(x, y), pieces.ids(x + 1, y));
            if (y + 1 < pieces.ids.height())
                meet(pieces.ids(x, y), pieces.ids(x, y + 1));
        }
    std::vector<std::vector<Border>> borders(lengths.size());
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        double sum = 0.0;
        for (const auto& [other, length] : lengths[i])
            sum += length;
        for (const auto& [other, length] : lengths[i])
            borders[i].push_back({static_cast<std::size_t>(other), length / sum});
    }
    return borders;
}

std::uint8_t best_of(const ClassScores& scores) {
    return static_cast<std::uint8_t>(
        std::distance(scores.begin(), std::max_element(scores.begin(), scores.end())));
}

// Iterated conditional modes in the order of the ids, until nothing changes.
void smooth(const std::vector<ClassScores>& scores, const std::vector<std::vector<Border>>& borders,
            double weight, int rounds, std::vector<std::uint8_t>& classes) {
    bool changed = weight > 0.0;
    for (int round = 0; round < rounds && changed; ++round) {
        changed = false;
        for (std::size_t i = 0; i < classes.size(); ++i) {
            ClassScores sum = scores[i];
            for (const auto& [other, share] : borders[i])
                sum[classes[other]] += weight * share;
            const std::uint8_t best = best_of(sum);
            changed = changed || best != classes[i];
            classes[i] = best;
        }
    }
}

void paint(const Superpixels& pieces, const std::vector<std::uint8_t>& classes,
           const std::vector<ClassScores>& scores, GroundRegions& regions) {
    for (int y = 0; y < regions.classes.height(); ++y)
        for (int x = 0; x < regions.classes.width(); ++x) {
            const auto id = static_cast<std::size_t>(
                pieces.ids(scaled_index(x, regions.classes.width(), pieces.ids.width()),
                           scaled_index(y, regions.classes.height(), pieces.ids.height())));
            regions.classes(x, y) = classes[id];
            regions.confidence(x, y) = static_cast<float>(std::exp(scores[id][classes[id]]));
        }
    for (const std::uint8_t kind : regions.classes)
        regions.shares[kind] += 1.0 / static_cast<double>(regions.classes.size());
    regions.pieces = pieces.count;
}

void check_slope(const FloatRaster& slope, const Photo& photo) {
    if (slope.empty())
        return;
    if (slope.width() != photo.width() || slope.height() != photo.height())
        fail<InvalidInput>("the slope has ", slope.width(), " x ", slope.height(),
                           " pixels, the photograph ", photo.width(), " x ", photo.height(),
                           "; they must agree");
    for (const float value : slope)
        if (!(value >= 0.0F && value <= 90.0F))
            fail<InvalidInput>("the slope holds ", value, ", must be in [0, 90] degrees");
}

}  // namespace

GroundRegions classify_ground(const Photo& photo, const GroundOptions& options,
                              const FloatRaster& slope, const GroundModel& model) {
    check(options);
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels");
    check_slope(slope, photo);

    const Raster<glm::vec3> lab = lab_of(working_picture(photo, options.max_side));
    const Superpixels pieces = superpixels(lab, options.superpixels);
    const std::vector<ClassScores> own = scores_of(model, ground_features(lab, pieces));
    std::vector<ClassScores> scores = own;
    if (!slope.empty())
        weigh_slope(slope, pieces, options.slope_weight, scores);
    std::vector<std::uint8_t> classes(scores.size());
    std::transform(scores.begin(), scores.end(), classes.begin(), best_of);
    smooth(scores, borders_of(pieces), options.smoothing, options.smoothing_rounds, classes);

    GroundRegions regions{Raster<std::uint8_t>(photo.width(), photo.height()),
                          FloatRaster(photo.width(), photo.height())};
    paint(pieces, classes, own, regions);
    return regions;
}

Photo draw_regions(const Photo& photo, const Raster<std::uint8_t>& classes) {
    constexpr std::array<glm::vec3, kGroundClasses> kTints = {
        glm::vec3(255, 216, 64), glm::vec3(150, 84, 30), glm::vec3(60, 140, 255),
        glm::vec3(200, 60, 200), glm::vec3(60, 200, 60)};
    Photo picture = photo;
    const int reach = std::max(photo.width(), photo.height()) > 1000 ? 2 : 1;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const std::uint8_t kind = classes(x, y);
            const bool border = (x + reach < picture.width() && classes(x + reach, y) != kind) ||
                                (y + reach < picture.height() && classes(x, y + reach) != kind);
            const glm::vec3 mixed =
                border ? glm::vec3(0.0F)
                       : glm::mix(glm::vec3(photo(x, y)), kTints[kind], 0.4F) + 0.5F;
            picture(x, y) = glm::u8vec3(mixed);
        }
    return picture;
}

}  // namespace scree::vision
