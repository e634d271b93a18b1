#include "vision/thesis/baseline_detectors.h"

#include "base/error.h"
#include "vision/thesis/grey.h"
#include "vision/thesis/working_size.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

Photo working_photo(const Photo& photo, const BaselineOptions& options) {
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels, at least one is needed");
    return scaled_photo(photo,
                        working_size({photo.width(), photo.height()}, options.working_width));
}

cv::Mat canny_edges(const Photo& working, const BaselineOptions& options) {
    const GreyRaster grey = grey_of(working);
    cv::Mat smooth(grey.height(), grey.width(), CV_8U, const_cast<std::uint8_t*>(grey.data()));
    smooth = smooth.clone();
    if (options.blur > 0.0)
        cv::GaussianBlur(smooth, smooth, cv::Size(), options.blur, options.blur);
    cv::Mat edges;
    cv::Canny(smooth, edges, options.low_share * options.high, options.high);
    return edges;
}

EdgeField field_of(const cv::Mat& edges, const Photo& photo) {
    Mask mask(edges.cols, edges.rows);
    for (int y = 0; y < edges.rows; ++y)
        std::copy_n(edges.ptr<std::uint8_t>(y), edges.cols, mask.row(y));
    mask = scaled_mask(mask, {photo.width(), photo.height()});
    EdgeField field;
    field.boundary = FloatRaster(photo.width(), photo.height());
    std::transform(mask.begin(), mask.end(), field.boundary.begin(),
                   [](std::uint8_t on) { return on != 0 ? 1.0F : 0.0F; });
    return field;
}

// One seed for each deep part of a cell between edges.
cv::Mat seeds_between(const cv::Mat& edges, double least_depth) {
    cv::Mat depth;
    cv::distanceTransform(edges == 0, depth, cv::DIST_L2, 3);
    const cv::Mat deep = depth > least_depth;
    cv::Mat seeds;
    cv::connectedComponents(deep, seeds, 4, CV_32S);
    return seeds;
}

}  // namespace

CannyDetector::CannyDetector(const BaselineOptions& options) : options_(options) {
    check(options);
}

EdgeField CannyDetector::detect(const Photo& photo, Progress*) const {
    return field_of(canny_edges(working_photo(photo, options_), options_), photo);
}

WatershedDetector::WatershedDetector(const BaselineOptions& options) : options_(options) {
    check(options);
}

EdgeField WatershedDetector::detect(const Photo& photo, Progress*) const {
    const Photo working = working_photo(photo, options_);
    cv::Mat regions = seeds_between(canny_edges(working, options_), options_.least_depth);
    const cv::Mat colours(working.height(), working.width(), CV_8UC3,
                          const_cast<glm::u8vec3*>(working.data()));
    cv::watershed(colours, regions);
    cv::Mat lines = regions == -1;
    // OpenCV draws the frame of the picture as a line too; no rock ends there.
    cv::rectangle(lines, cv::Rect(0, 0, lines.cols, lines.rows), cv::Scalar(0));
    return field_of(lines, photo);
}

}  // namespace scree::vision
