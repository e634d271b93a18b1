#include "vision/classify/ground_features.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {

namespace {

constexpr double kWindow = 10.0;  // standard deviation of the window, px
constexpr int kBands = 5;
constexpr float kFloor = 0.05F;  // of L*: below the noise of any camera

cv::Mat blurred(const cv::Mat& picture, double sigma) {
    cv::Mat result;
    cv::GaussianBlur(picture, result, cv::Size(), sigma, sigma, cv::BORDER_REFLECT);
    return result;
}

cv::Mat log_of_root(const cv::Mat& square) {
    cv::Mat result;
    cv::sqrt(cv::max(square, 0.0), result);
    cv::log(result + kFloor, result);
    return result;
}

// Logarithm of the deviation of a channel in the window.
cv::Mat log_spread(const cv::Mat& channel) {
    const cv::Mat mean = blurred(channel, kWindow);
    return log_of_root(blurred(channel.mul(channel), kWindow) - mean.mul(mean));
}

// Logarithm of how much the band's fourth moment exceeds the square of its second: 0 for even
// alternation, large where detail is rare (cracks on smooth ground).
cv::Mat peakedness(const cv::Mat& band) {
    const cv::Mat square = band.mul(band);
    const cv::Mat second = blurred(square, kWindow) + 1e-4;
    cv::Mat ratio;
    cv::log((blurred(square.mul(square), kWindow) + 1e-8) / second.mul(second), ratio);
    return ratio;
}

// How much the gradient keeps to one direction over `reach` px, 0 to 1, averaged in the window by
// its strength.
cv::Mat coherence(const cv::Mat& lightness, double reach) {
    const cv::Mat smooth = blurred(lightness, 0.8);
    cv::Mat gx;
    cv::Mat gy;
    cv::Scharr(smooth, gx, CV_32F, 1, 0, 1.0 / 32.0, 0.0, cv::BORDER_REFLECT);
    cv::Scharr(smooth, gy, CV_32F, 0, 1, 1.0 / 32.0, 0.0, cv::BORDER_REFLECT);
    const cv::Mat xx = blurred(gx.mul(gx), reach);
    const cv::Mat yy = blurred(gy.mul(gy), reach);
    const cv::Mat xy = blurred(gx.mul(gy), reach);
    const cv::Mat difference = xx - yy;
    cv::Mat along;
    cv::sqrt(difference.mul(difference) + 4.0 * xy.mul(xy), along);
    return blurred(along, kWindow) / (blurred(xx + yy, kWindow) + 1e-3);
}

// Colours: means in the superpixel alone, so that borders stay sharp.
void add_colour(const cv::Mat channels[3], std::vector<cv::Mat>& maps) {
    cv::Mat chroma;
    cv::magnitude(channels[1], channels[2], chroma);
    maps.insert(maps.end(), {channels[0], channels[1], channels[2], chroma});
}

// Bands between Gaussians an octave apart; their energies tell the size of grains.
void add_detail(const cv::Mat& lightness, std::vector<cv::Mat>& maps) {
    maps.push_back(log_spread(lightness));
    std::vector<cv::Mat> bands;
    std::vector<cv::Mat> energies;
    cv::Mat fine = lightness;
    double sigma = 1.0;
    cv::Mat weighted = cv::Mat::zeros(lightness.size(), CV_32F);
    cv::Mat total = cv::Mat::zeros(lightness.size(), CV_32F);
    for (int band = 0; band < kBands; ++band, sigma *= 2.0) {
        const cv::Mat coarse = blurred(lightness, sigma);
        bands.push_back(fine - coarse);
        const cv::Mat energy = blurred(bands.back().mul(bands.back()), kWindow);
        energies.push_back(log_of_root(energy));
        maps.push_back(energies.back());
        weighted += static_cast<double>(band) * energy;
        total += energy;
        fine = coarse;
    }
    maps.push_back(weighted / (total + 1e-3));  // octaves above a pixel

    const cv::Mat off = lightness - blurred(lightness, kWindow);
    const cv::Mat variance = blurred(off.mul(off), kWindow) + 0.1;
    cv::Mat cubed;
    cv::pow(variance, 1.5, cubed);
    maps.push_back(blurred(off.mul(off).mul(off), kWindow) / cubed);
    maps.push_back(peakedness(bands[0] + bands[1]));
    maps.push_back(peakedness(bands[2] + bands[3]));
    maps.push_back(coherence(lightness, 1.5));
    maps.push_back(coherence(lightness, 4.0));
    maps.push_back(coherence(lightness, kWindow));
    maps.push_back({});  // filled with the spreads of colour by the caller
    maps.push_back({});
    const cv::Mat dark = off < -0.25 * blurred(lightness, kWindow);
    cv::Mat share;
    dark.convertTo(share, CV_32F, 1.0 / 255.0);
    maps.push_back(blurred(share, kWindow));
    maps.push_back(energies[0] - energies[2]);
    maps.push_back(energies[2] - energies[4]);
}

}  // namespace

std::vector<GroundFeatures> ground_features(const Raster<glm::vec3>& lab,
                                            const Superpixels& pieces) {
    std::vector<GroundFeatures> features(static_cast<std::size_t>(pieces.count));
    if (lab.empty())
        return features;
    const cv::Mat view(lab.height(), lab.width(), CV_32FC3,
                       const_cast<glm::vec3*>(lab.data()));  // only read
    cv::Mat channels[3];
    cv::split(view, channels);
    std::vector<cv::Mat> maps;
    add_colour(channels, maps);
    add_detail(channels[0], maps);
    maps[17] = log_spread(channels[1]);
    maps[18] = log_spread(channels[2]);

    std::vector<double> area(features.size());
    for (const std::int32_t id : pieces.ids)
        area[static_cast<std::size_t>(id)] += 1.0;
    parallel_for_each_index(0, kGroundFeatures, 1, [&](std::size_t feature) {
        std::vector<double> sums(features.size());
        for (int y = 0; y < lab.height(); ++y) {
            const auto* row = maps[feature].ptr<float>(y);
            for (int x = 0; x < lab.width(); ++x)
                sums[static_cast<std::size_t>(pieces.ids(x, y))] += static_cast<double>(row[x]);
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            features[i][feature] = static_cast<float>(sums[i] / area[i]);
    });
    return features;
}

}  // namespace scree::vision
