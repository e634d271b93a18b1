#include "base/random.h"
#include "testdata/scene_light.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::test {
namespace {

constexpr std::uint64_t kSensorStream = 37;

double coded(double light) {
    const double v = std::clamp(light, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

// The tables K.1 and K.2 of ITU-T T.81, up to their scale.
constexpr std::array<int, 64> kLumaSteps{
    16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
    14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
    18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};

void quantise(cv::Mat& plane, int quality, bool is_colour) {
    const double scale = quality < 50 ? 50.0 / quality : 2.0 - quality / 50.0;
    cv::Mat padded;
    cv::copyMakeBorder(plane, padded, 0, (8 - plane.rows % 8) % 8, 0, (8 - plane.cols % 8) % 8,
                       cv::BORDER_REPLICATE);
    cv::Mat block;
    for (int y = 0; y < padded.rows; y += 8)
        for (int x = 0; x < padded.cols; x += 8) {
            cv::Mat part = padded(cv::Rect(x, y, 8, 8));
            cv::dct(part, block);
            for (int k = 0; k < 64; ++k) {
                const int step = is_colour ? (k < 2 || k == 8 ? 18
                                              : k < 20        ? 50
                                                              : 99)
                                           : kLumaSteps[static_cast<std::size_t>(k)];
                const float width = static_cast<float>(std::max(1.0, scale * step));
                float& value = block.at<float>(k / 8, k % 8);
                value = width * std::nearbyint(value / width);
            }
            cv::idct(block, part);
        }
    padded(cv::Rect(0, 0, plane.cols, plane.rows)).copyTo(plane);
}

// Cameras measure the light: dark heaps come out brighter than they are, light ones darker.
double measured_exposure(const std::array<FloatRaster, 3>& light) {
    double sum = 0.0;
    for (const float value : light[1])
        sum += std::min(1.0, static_cast<double>(value));
    const double mean = sum / std::max(1.0, static_cast<double>(light[1].size()));
    return std::clamp(std::pow(0.18 / std::max(0.01, mean), 0.7), 0.3, 3.0);
}

cv::Mat focused(const FloatRaster& channel, const SceneOptions& o) {
    const cv::Mat canvas(channel.height(), channel.width(), CV_32F,
                         const_cast<float*>(channel.data()));
    cv::Mat soft = canvas;
    if (o.blur > 0.0)
        cv::GaussianBlur(canvas, soft, cv::Size(), kOversampling * o.blur, kOversampling * o.blur);
    const cv::Mat view =
        soft(cv::Rect(kMargin, kMargin, kOversampling * o.width, kOversampling * o.height));
    cv::Mat small;
    cv::resize(view, small, cv::Size(o.width, o.height), 0, 0, cv::INTER_AREA);
    return small;
}

}  // namespace

Photo develop(const std::array<FloatRaster, 3>& light, const SceneOptions& o) {
    Photo photo(o.width, o.height);
    const double metered = o.exposure * measured_exposure(light);
    const std::array<double, 3> balance{1.0 + 0.25 * o.warmth, 1.0, 1.0 - 0.25 * o.warmth};
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        cv::Mat picture = focused(light[channel], o);
        for (int y = 0; y < o.height; ++y) {
            Rng rng({.seed = o.seed,
                     .stream = kSensorStream,
                     .step = channel,
                     .cell = static_cast<std::uint64_t>(y)});
            for (int x = 0; x < o.width; ++x) {
                float& value = picture.at<float>(y, x);
                const double exposed = metered * balance[channel] * static_cast<double>(value);
                const double grain =
                    o.noise * rng.normal() * (0.4 + std::sqrt(std::max(0.0, exposed)));
                value = static_cast<float>(
                    0.5 + o.contrast * (coded(exposed + 0.3 * grain) - 0.5 + 0.5 * grain));
            }
        }
        cv::Mat soft;
        cv::GaussianBlur(picture, soft, cv::Size(), 1.2);
        picture += o.sharpening * (picture - soft);
        for (int y = 0; y < o.height; ++y)
            for (int x = 0; x < o.width; ++x)
                photo(x, y)[c] = cv::saturate_cast<std::uint8_t>(255.0F * picture.at<float>(y, x));
    }
    if (o.jpeg_quality < 100)
        compress(photo, o.jpeg_quality);
    return photo;
}

void compress(Photo& photo, int quality) {
    cv::Mat picture(photo.height(), photo.width(), CV_8UC3, photo.data());
    cv::Mat coded_picture;
    cv::cvtColor(picture, coded_picture, cv::COLOR_RGB2YCrCb);
    std::vector<cv::Mat> planes;
    cv::split(coded_picture, planes);
    for (std::size_t c = 0; c < planes.size(); ++c) {
        cv::Mat plane;
        planes[c].convertTo(plane, CV_32F);
        const cv::Size full = plane.size();
        if (c > 0)
            cv::resize(plane, plane, cv::Size((full.width + 1) / 2, (full.height + 1) / 2), 0, 0,
                       cv::INTER_AREA);
        quantise(plane, quality, c > 0);
        if (c > 0)
            cv::resize(plane, plane, full, 0, 0, cv::INTER_LINEAR);
        plane.convertTo(planes[c], CV_8U);
    }
    cv::merge(planes, coded_picture);
    cv::cvtColor(coded_picture, picture, cv::COLOR_YCrCb2RGB);
}

}  // namespace scree::test
