#include "vision/relief_signal.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr double kFineShare = 0.1;    // of the rock's radius: what is smoothed away
constexpr double kCoarseShare = 2.0;  // of the rock's radius: what belongs to the rocks themselves
constexpr double kLeastSmoothing = 0.7;
constexpr double kDarkest = 0.02;  // keeps the logarithm of black in bounds
constexpr double kEven = 1e-4;     // a plane that spreads less than this says nothing
constexpr std::size_t kRowsAPiece = 32;

cv::Mat log_luma(const Photo& photo) {
    const cv::Mat colours(photo.height(), photo.width(), CV_8UC3,
                          const_cast<glm::u8vec3*>(photo.data()));
    cv::Mat luma;
    cv::cvtColor(colours, luma, cv::COLOR_RGB2GRAY);
    cv::Mat table(1, 256, CV_32F);
    for (int v = 0; v < 256; ++v)
        table.at<float>(v) = static_cast<float>(std::log(v / 255.0 + kDarkest));
    cv::Mat logarithm;
    cv::LUT(luma, table, logarithm);
    return logarithm;
}

// A wide Gaussian on a picture reduced until it is two pixels wide: as good, and cheap at any
// width.
cv::Mat smoothed(const cv::Mat& plane, double sigma) {
    const int shorter = std::min(plane.cols, plane.rows);
    const int factor = std::clamp(static_cast<int>(sigma / 2.0), 1, std::max(1, shorter / 2));
    cv::Mat result;
    if (factor == 1) {
        cv::GaussianBlur(plane, result, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
        return result;
    }
    cv::Mat small;
    const cv::Size size((plane.cols + factor - 1) / factor, (plane.rows + factor - 1) / factor);
    cv::resize(plane, small, size, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, cv::Size(), sigma / factor, sigma / factor,
                     cv::BORDER_REPLICATE);
    cv::resize(small, result, plane.size(), 0, 0, cv::INTER_LINEAR);
    return result;
}

struct Spread {
    float mean = 0.0F;
    float scale = 0.0F;  // 1 / standard deviation; 0 for an even plane
};

// Sums of rows, added in their order, so that the threads do not matter.
Spread spread_of(const cv::Mat& plane) {
    std::vector<std::array<double, 2>> rows(static_cast<std::size_t>(plane.rows));
    parallel_for_each_index(0, rows.size(), kRowsAPiece, [&](std::size_t y) {
        const float* row = plane.ptr<float>(static_cast<int>(y));
        for (int x = 0; x < plane.cols; ++x) {
            const auto value = static_cast<double>(row[x]);
            rows[y][0] += value;
            rows[y][1] += value * value;
        }
    });
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& row : rows) {
        sum += row[0];
        squares += row[1];
    }
    const double n = static_cast<double>(plane.total());
    const double mean = sum / n;
    const double deviation = std::sqrt(std::max(0.0, squares / n - mean * mean));
    return {static_cast<float>(mean),
            deviation > kEven ? static_cast<float>(1.0 / deviation) : 0.0F};
}

SCREE_MULTIVERSION void bend_row(float* __restrict values, int n) {
    for (int x = 0; x < n; ++x)
        values[x] = values[x] / std::sqrt(1.0F + values[x] * values[x]);
}

void check_input(const Photo& photo, const FloatRaster& boundary, double rock_radius) {
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels");
    if (!boundary.empty() &&
        (boundary.width() != photo.width() || boundary.height() != photo.height()))
        fail<InvalidInput>("the boundary has ", boundary.width(), " x ", boundary.height(),
                           " pixels, the photograph ", photo.width(), " x ", photo.height());
    // Counted rather than stopped at the first, so that the loop runs in vector registers.
    std::size_t n_bad = 0;
    for (const float v : boundary)
        n_bad += std::abs(v) <= 1e6F ? 0 : 1;
    if (n_bad > 0)
        fail<InvalidInput>("the boundary holds ", n_bad, " values that are no numbers");
    if (!(rock_radius >= 1.0 && rock_radius <= 1e5))
        fail<InvalidInput>("the rocks' radius is ", rock_radius, " px, must be in [1, 1e5]");
}

}  // namespace

FloatRaster relief_signal(const Photo& photo, const FloatRaster& boundary, double rock_radius) {
    check_input(photo, boundary, rock_radius);
    FloatRaster signal(photo.width(), photo.height());
    cv::Mat result(photo.height(), photo.width(), CV_32F, signal.data());
    const double fine = std::max(kLeastSmoothing, kFineShare * rock_radius);
    const cv::Mat luma = log_luma(photo);
    const cv::Mat band = smoothed(luma, fine) - smoothed(luma, kCoarseShare * rock_radius);
    const Spread bright = spread_of(band);
    if (boundary.empty()) {
        band.convertTo(result, CV_32F, bright.scale, -bright.mean * bright.scale);
    } else {
        const cv::Mat edges = smoothed(cv::Mat(boundary.height(), boundary.width(), CV_32F,
                                               const_cast<float*>(boundary.data())),
                                       fine);
        const Spread border = spread_of(edges);
        // The difference of two independent planes of unit spread has the spread sqrt(2).
        const double half = std::sqrt(0.5);
        cv::addWeighted(band, half * bright.scale, edges, -half * border.scale,
                        half * (border.mean * border.scale - bright.mean * bright.scale), result);
    }
    parallel_for_each_index(
        0, static_cast<std::size_t>(signal.height()), kRowsAPiece,
        [&](std::size_t y) { bend_row(signal.row(static_cast<int>(y)), signal.width()); });
    return signal;
}

}  // namespace scree::vision
