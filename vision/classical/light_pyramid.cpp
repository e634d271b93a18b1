#include "vision/classical/light_pyramid.h"

#include "base/error.h"
#include "base/parallel.h"

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr std::size_t kPhases = 4;
constexpr int kPadTo = 1 << (kPyramidLevels - 1);
// Below this spread (six grey levels of 255) there is nothing to see but noise.
constexpr float kSpreadFloor = 0.025F;

struct Planes {
    cv::Mat luma;
    cv::Mat red_green;
    cv::Mat yellow_blue;
};

cv::Mat view(FloatRaster& raster) {
    return {raster.height(), raster.width(), CV_32FC1, raster.data()};
}

Planes split(const Photo& photo) {
    const int w = (photo.width() + kPadTo - 1) / kPadTo * kPadTo;
    const int h = (photo.height() + kPadTo - 1) / kPadTo * kPadTo;
    Planes planes{cv::Mat(h, w, CV_32F), cv::Mat(h, w, CV_32F), cv::Mat(h, w, CV_32F)};
    parallel_for_each_index(0, static_cast<std::size_t>(h), 64, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const glm::u8vec3* in = photo.row(std::min(y, photo.height() - 1));
        auto* luma = planes.luma.ptr<float>(y);
        auto* red_green = planes.red_green.ptr<float>(y);
        auto* yellow_blue = planes.yellow_blue.ptr<float>(y);
        for (int x = 0; x < w; ++x) {
            const glm::u8vec3 c = in[std::min(x, photo.width() - 1)];
            const float r = static_cast<float>(c.r) / 255, g = static_cast<float>(c.g) / 255,
                        b = static_cast<float>(c.b) / 255;
            luma[x] = 0.299F * r + 0.587F * g + 0.114F * b;
            red_green[x] = r - g;
            yellow_blue[x] = 0.5F * (r + g) - b;
        }
    });
    return planes;
}

// Local mean and root mean square over about 12 pixels, worked out at a quarter of the width.
void local_light(const cv::Mat& luma, cv::Mat& mean, cv::Mat& spread) {
    cv::Mat small, squares;
    const cv::Size quarter(std::max(1, (luma.cols + 3) / 4), std::max(1, (luma.rows + 3) / 4));
    cv::resize(luma, small, quarter, 0, 0, cv::INTER_AREA);
    cv::resize(luma.mul(luma), squares, quarter, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {0, 0}, 3.0, 3.0, cv::BORDER_REPLICATE);
    cv::GaussianBlur(squares, squares, {0, 0}, 3.0, 3.0, cv::BORDER_REPLICATE);
    cv::Mat variance = squares - small.mul(small);
    cv::max(variance, 0.0F, variance);
    variance += kSpreadFloor * kSpreadFloor;
    cv::sqrt(variance, variance);
    cv::resize(small, mean, luma.size(), 0, 0, cv::INTER_LINEAR);
    cv::resize(variance, spread, luma.size(), 0, 0, cv::INTER_LINEAR);
}

cv::Mat local_mean(const cv::Mat& plane) {
    cv::Mat small, mean;
    const cv::Size quarter(std::max(1, (plane.cols + 3) / 4), std::max(1, (plane.rows + 3) / 4));
    cv::resize(plane, small, quarter, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {0, 0}, 3.0, 3.0, cv::BORDER_REPLICATE);
    cv::resize(small, mean, plane.size(), 0, 0, cv::INTER_LINEAR);
    return mean;
}

FloatRaster with_margin(const cv::Mat& plane) {
    constexpr int m = LightLevel::kMargin;
    FloatRaster raster(plane.cols + 2 * m, plane.rows + 2 * m);
    cv::Mat out = view(raster);
    cv::copyMakeBorder(plane, out, m, m, m, m, cv::BORDER_REPLICATE);
    return raster;
}

LightLevel normalised(const Planes& planes) {
    cv::Mat mean, spread;
    local_light(planes.luma, mean, spread);
    LightLevel level;
    level.width = planes.luma.cols;
    level.height = planes.luma.rows;
    level.grey = with_margin((planes.luma - mean) / spread);
    level.red_green = with_margin((planes.red_green - local_mean(planes.red_green)) / spread);
    level.yellow_blue = with_margin((planes.yellow_blue - local_mean(planes.yellow_blue)) / spread);
    level.luma = with_margin(planes.luma);
    level.spread = with_margin(spread);
    return level;
}

// Half the size, blurred enough that the outcome hardly depends on which rows are paired.
Planes halved(const Planes& planes) {
    const auto halve = [](const cv::Mat& plane) {
        cv::Mat soft, half;
        cv::GaussianBlur(plane, soft, {3, 3}, 0.85, 0.85, cv::BORDER_REPLICATE);
        cv::resize(soft, half, {plane.cols / 2, plane.rows / 2}, 0, 0, cv::INTER_AREA);
        return half;
    };
    return {halve(planes.luma), halve(planes.red_green), halve(planes.yellow_blue)};
}

// The same without its first columns and rows, the last ones repeated instead.
Planes shifted(const Planes& planes, int dx, int dy) {
    const auto shift = [&](const cv::Mat& plane) {
        cv::Mat out;
        cv::copyMakeBorder(plane(cv::Rect(dx, dy, plane.cols - dx, plane.rows - dy)), out, 0, dy, 0,
                           dx, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
        return out;
    };
    return {shift(planes.luma), shift(planes.red_green), shift(planes.yellow_blue)};
}

// All phases of a level and what is coarser, from the planes of the next finer level.
std::vector<PhasedLevel> phased(const Planes& finer, int level) {
    if (level >= kPyramidLevels)
        return {};
    std::vector<PhasedLevel> phases(kPhases);
    parallel_for_each_index(0, phases.size(), 1, [&](std::size_t i) {
        PhasedLevel& phase = phases[i];
        phase.dx = static_cast<int>(i % 2);
        phase.dy = static_cast<int>(i / 2);
        const Planes planes = halved(shifted(finer, phase.dx, phase.dy));
        phase.level = normalised(planes);
        phase.coarser = phased(planes, level + 1);
    });
    return phases;
}

}  // namespace

LightPyramid light_pyramid(const Photo& photo) {
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels");
    LightPyramid pyramid;
    const Planes planes = split(photo);
    parallel_invoke([&] { pyramid.fine[0] = normalised(planes); },
                    [&] {
                        const Planes half = halved(planes);
                        parallel_invoke([&] { pyramid.fine[1] = normalised(half); },
                                        [&] { pyramid.coarse = phased(half, kFineLevels); });
                    });
    return pyramid;
}

}  // namespace scree::vision
