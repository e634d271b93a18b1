#include "vision/thesis/grey.h"

#include "base/error.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace scree::vision {

GreyRaster grey_of(const Photo& photo) {
    GreyRaster grey(photo.width(), photo.height());
    // 14-bit weights that add up to one, so that grey stays grey.
    std::transform(photo.begin(), photo.end(), grey.begin(), [](glm::u8vec3 c) {
        const unsigned sum = 4899U * c.r + 9617U * c.g + 1868U * c.b;
        return static_cast<std::uint8_t>((sum + 8192U) >> 14U);
    });
    return grey;
}

GreyRaster median_filtered(const GreyRaster& grey, int kernel) {
    if (grey.empty())
        fail<InvalidInput>("a picture without pixels has no median; give at least one pixel");
    if (kernel == 1)
        return grey;
    GreyRaster result(grey.width(), grey.height());
    const cv::Mat from(grey.height(), grey.width(), CV_8U, const_cast<std::uint8_t*>(grey.data()));
    cv::Mat to(result.height(), result.width(), CV_8U, result.data());
    cv::medianBlur(from, to, kernel);
    return result;
}

}  // namespace scree::vision
