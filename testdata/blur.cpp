#include "testdata/blur.h"

#include <opencv2/imgproc.hpp>

namespace scree::test {

FloatRaster blurred(const FloatRaster& source, double sigma) {
    FloatRaster result(source.width(), source.height());
    // const_cast: OpenCV has no view of constant data; the source is only read.
    const cv::Mat from(source.height(), source.width(), CV_32F, const_cast<float*>(source.data()));
    cv::Mat to(result.height(), result.width(), CV_32F, result.data());
    cv::GaussianBlur(from, to, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
    return result;
}

}  // namespace scree::test
