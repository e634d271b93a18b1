#include "vision/learned/rock_sizes.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr int kCell = 8;
constexpr double kWindow = 6.0;  // standard deviation, cells
constexpr float kLeastDiameter = 4.0F;
constexpr float kUnknown = 5.0F;

cv::Mat rock_mask(const EdgeField& field) {
    cv::Mat mask(field.inside.height(), field.inside.width(), CV_8U);
    for (int y = 0; y < mask.rows; ++y)
        for (int x = 0; x < mask.cols; ++x)
            mask.at<std::uint8_t>(y, x) =
                field.inside(x, y) > 0.5F && field.boundary(x, y) < 0.5F ? 1 : 0;
    return mask;
}

// Sums over one row of cells. A pixel weighs 1 over the area of its rock, so that a rock weighs 1.
void gather_cells(const EdgeField& field, const cv::Mat& mask, const cv::Mat& depth, int row,
                  cv::Mat& weights, cv::Mat& sums) {
    for (int y = row * kCell; y < std::min((row + 1) * kCell, mask.rows); ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            const float relative = field.distance(x, y);
            if (mask.at<std::uint8_t>(y, x) == 0 || relative <= 0.35F)
                continue;
            const float diameter =
                std::max(kLeastDiameter, 2.0F * depth.at<float>(y, x) / relative);
            const float weight = 1.0F / (diameter * diameter);
            weights.at<float>(row, x / kCell) += weight;
            sums.at<float>(row, x / kCell) += weight * std::log2(diameter);
        }
    }
}

}  // namespace

FloatRaster local_rock_sizes(const EdgeField& field) {
    const int width = field.inside.width(), height = field.inside.height();
    const cv::Mat mask = rock_mask(field);
    cv::Mat depth;
    // A frame of the same keeps rocks at the picture's edge from counting as deep.
    cv::Mat framed;
    cv::copyMakeBorder(mask, framed, 1, 1, 1, 1, cv::BORDER_REPLICATE);
    cv::distanceTransform(framed, depth, cv::DIST_L2, cv::DIST_MASK_5);
    depth = depth(cv::Rect(1, 1, width, height));
    const cv::Size cells((width + kCell - 1) / kCell, (height + kCell - 1) / kCell);
    cv::Mat weights = cv::Mat::zeros(cells, CV_32F), sums = cv::Mat::zeros(cells, CV_32F);
    parallel_for_each_index(0, static_cast<std::size_t>(cells.height), 4, [&](std::size_t row) {
        gather_cells(field, mask, depth, static_cast<int>(row), weights, sums);
    });
    cv::GaussianBlur(weights, weights, {0, 0}, kWindow, kWindow, cv::BORDER_REFLECT_101);
    cv::GaussianBlur(sums, sums, {0, 0}, kWindow, kWindow, cv::BORDER_REFLECT_101);
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            const float weight = weights.at<float>(y, x);
            float& sum = sums.at<float>(y, x);
            sum = weight > 1e-12F ? sum / weight : kUnknown;
        }
    cv::Mat fine;
    cv::resize(sums, fine, {cells.width * kCell, cells.height * kCell}, 0, 0, cv::INTER_LINEAR);
    FloatRaster sizes(width, height);
    cv::Mat to(height, width, CV_32F, sizes.data());
    fine(cv::Rect(0, 0, width, height)).copyTo(to);
    return sizes;
}

}  // namespace scree::vision
