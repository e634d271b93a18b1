#include "vision/classical/pixel_features.h"

#include "base/simd.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

// Rows and columns measured around a strip, so that neither blurs nor taps see where it ends.
constexpr int kHalo = 36;
static_assert(kHalo <= LightLevel::kMargin);

struct Tap {
    int plane;
    int dx;
    int dy;
};

cv::Mat strip_of(const FloatRaster& raster, int first, int last) {
    constexpr int m = LightLevel::kMargin;
    // const_cast: OpenCV has no view of constant data; the strip is only read.
    auto* row = const_cast<float*>(raster.row(first - kHalo + m));
    return {last - first + 2 * kHalo, raster.width(), CV_32FC1, row};
}

cv::Mat blur(const cv::Mat& in, double sigma) {
    cv::Mat out;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    cv::GaussianBlur(in, out, {2 * radius + 1, 2 * radius + 1}, sigma, sigma,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    return out;
}

cv::Mat box(const cv::Mat& in, int size) {
    cv::Mat out;
    cv::blur(in, out, {size, size}, {-1, -1}, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    return out;
}

// Slope and the two principal curvatures of one row, in units of the blur's own width.
SCREE_MULTIVERSION void derive_row(const float* up, const float* mid, const float* down, int n,
                                   float sigma, float* slope, float* high, float* low) {
    const float s1 = 0.5F * sigma, s2 = sigma * sigma;
    for (int x = 1; x < n - 1; ++x) {
        const float gx = s1 * (mid[x + 1] - mid[x - 1]);
        const float gy = s1 * (down[x] - up[x]);
        const float xx = s2 * (mid[x + 1] - 2 * mid[x] + mid[x - 1]);
        const float yy = s2 * (down[x] - 2 * mid[x] + up[x]);
        const float xy = 0.25F * s2 * (down[x + 1] - down[x - 1] - up[x + 1] + up[x - 1]);
        const float half = 0.5F * (xx + yy);
        const float root = std::sqrt(0.25F * (xx - yy) * (xx - yy) + xy * xy);
        slope[x] = std::sqrt(gx * gx + gy * gy);
        high[x] = half + root;
        low[x] = half - root;
    }
}

void derive(const cv::Mat& in, float sigma, std::vector<cv::Mat>& planes) {
    cv::Mat slope = cv::Mat::zeros(in.size(), CV_32F), high = slope.clone(), low = slope.clone();
    for (int y = 1; y < in.rows - 1; ++y)
        derive_row(in.ptr<float>(y - 1), in.ptr<float>(y), in.ptr<float>(y + 1), in.cols, sigma,
                   slope.ptr<float>(y), high.ptr<float>(y), low.ptr<float>(y));
    planes.insert(planes.end(), {slope, high, low});
}

SCREE_MULTIVERSION void colour_row(const float* const* a, const float* const* b, int n, float scale,
                                   float* slope) {
    for (int x = 1; x < n - 1; ++x) {
        const float ax = a[1][x + 1] - a[1][x - 1], ay = a[2][x] - a[0][x];
        const float bx = b[1][x + 1] - b[1][x - 1], by = b[2][x] - b[0][x];
        slope[x] = scale * std::sqrt(ax * ax + ay * ay + bx * bx + by * by);
    }
}

cv::Mat colour_slope(const cv::Mat& a, const cv::Mat& b, float sigma) {
    cv::Mat slope = cv::Mat::zeros(a.size(), CV_32F);
    for (int y = 1; y < a.rows - 1; ++y) {
        const float* rows_a[] = {a.ptr<float>(y - 1), a.ptr<float>(y), a.ptr<float>(y + 1)};
        const float* rows_b[] = {b.ptr<float>(y - 1), b.ptr<float>(y), b.ptr<float>(y + 1)};
        colour_row(rows_a, rows_b, a.cols, 0.5F * sigma, slope.ptr<float>(y));
    }
    return slope;
}

SCREE_MULTIVERSION void tensor_row(const float* xx, const float* yy, const float* xy, int n,
                                   float* strength, float* coherence) {
    for (int x = 0; x < n; ++x) {
        const float root = std::sqrt((xx[x] - yy[x]) * (xx[x] - yy[x]) + 4 * xy[x] * xy[x]);
        strength[x] = std::sqrt(0.5F * (xx[x] + yy[x] + root) + 1e-12F);
        coherence[x] = root / (xx[x] + yy[x] + 0.01F);
    }
}

// Strength and straightness of the slopes around a pixel.
void tensor(const cv::Mat& in, std::vector<cv::Mat>& planes) {
    const cv::Mat dx = (cv::Mat_<float>(1, 3) << -0.5F, 0, 0.5F);
    cv::Mat gx, gy;
    const int border = cv::BORDER_REPLICATE | cv::BORDER_ISOLATED;
    cv::filter2D(in, gx, CV_32F, dx, {-1, -1}, 0, border);
    cv::filter2D(in, gy, CV_32F, dx.t(), {-1, -1}, 0, border);
    const cv::Mat xx = box(gx.mul(gx), 7), yy = box(gy.mul(gy), 7), xy = box(gx.mul(gy), 7);
    cv::Mat strength(in.size(), CV_32F), coherence(in.size(), CV_32F);
    for (int y = 0; y < in.rows; ++y)
        tensor_row(xx.ptr<float>(y), yy.ptr<float>(y), xy.ptr<float>(y), in.cols,
                   strength.ptr<float>(y), coherence.ptr<float>(y));
    planes.insert(planes.end(), {strength, coherence});
}

cv::Mat hat(const cv::Mat& in, int size, int kind) {
    cv::Mat out;
    cv::morphologyEx(in, out, kind, cv::Mat::ones(size, size, CV_8U), {-1, -1}, 1,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    return out;
}

// Eight places on a circle, in whole pixels.
void ring(int plane, int radius, std::vector<Tap>& taps) {
    const int d = static_cast<int>(std::lround(radius * 0.7071));
    for (const auto& [dx, dy] : {std::pair{radius, 0},
                                 {d, d},
                                 {0, radius},
                                 {-d, d},
                                 {-radius, 0},
                                 {-d, -d},
                                 {0, -radius},
                                 {d, -d}})
        taps.push_back({plane, dx, dy});
}

}  // namespace

struct FeatureStrip::Planes {
    int first = 0;
    std::vector<cv::Mat> planes;
    std::vector<Tap> taps;
};

FeatureStrip::FeatureStrip(const LightLevel& level, const Context& context, int first, int last)
    : planes_(std::make_unique<Planes>()) {
    planes_->first = first;
    std::vector<cv::Mat>& p = planes_->planes;
    const cv::Mat grey = strip_of(level.grey, first, last);
    const cv::Mat fine = blur(grey, 1.0), middle = blur(fine, 1.732), wide = blur(middle, 3.464);
    p.insert(p.end(), {grey, fine, middle, wide, strip_of(level.luma, first, last),
                       strip_of(level.spread, first, last)});
    derive(fine, 1.0F, p);
    derive(middle, 2.0F, p);
    derive(wide, 4.0F, p);
    const cv::Mat a = blur(strip_of(level.red_green, first, last), 1.5);
    const cv::Mat b = blur(strip_of(level.yellow_blue, first, last), 1.5);
    p.insert(p.end(),
             {a, b, colour_slope(a, b, 1.5F), colour_slope(blur(a, 2.6), blur(b, 2.6), 3.0F)});
    p.push_back(box(cv::abs(grey - fine), 5));
    p.push_back(box(cv::abs(fine - middle), 9));
    tensor(fine, p);
    p.insert(p.end(), {hat(grey, 5, cv::MORPH_BLACKHAT), hat(fine, 13, cv::MORPH_BLACKHAT),
                       hat(fine, 13, cv::MORPH_TOPHAT)});
    std::vector<Tap>& taps = planes_->taps;
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
        taps.push_back({i, 0, 0});
    ring(1, 3, taps);
    ring(2, 7, taps);
    for (const auto& plane : context) {
        p.push_back(strip_of(plane, first, last));
        const int index = static_cast<int>(p.size()) - 1;
        taps.push_back({index, 0, 0});
        ring(index, 6, taps);
    }
}

FeatureStrip::~FeatureStrip() = default;

int FeatureStrip::count() const {
    return static_cast<int>(planes_->taps.size());
}

const float* FeatureStrip::row(int i, int y) const {
    const Tap& tap = planes_->taps[static_cast<std::size_t>(i)];
    const cv::Mat& plane = planes_->planes[static_cast<std::size_t>(tap.plane)];
    return plane.ptr<float>(y - planes_->first + kHalo + tap.dy) + LightLevel::kMargin + tap.dx;
}

}  // namespace scree::vision
