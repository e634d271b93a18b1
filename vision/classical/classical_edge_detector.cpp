#include "vision/classical/classical_edge_detector.h"

#include "base/error.h"
#include "base/parallel.h"

#include <array>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr int kStripRows = 128;  // fixed, so that the pieces do not depend on the thread count
constexpr std::size_t kChannels = 3;

void fill_strip(const FeatureStrip& strip, const Mlp& mlp, int first, int last, Context& field) {
    MlpScratch scratch;
    std::vector<const float*> inputs(static_cast<std::size_t>(strip.count()));
    const int width = field[0].width();
    for (int y = first; y < last; ++y) {
        for (int x = 0; x < width; x += kMlpBlock) {
            for (std::size_t i = 0; i < inputs.size(); ++i)
                inputs[i] = strip.row(static_cast<int>(i), y) + x;
            const std::array<float*, kChannels> outputs = {field[0].row(y) + x, field[1].row(y) + x,
                                                           field[2].row(y) + x};
            evaluate_block(mlp, inputs, std::min(kMlpBlock, width - x), outputs, scratch);
        }
    }
}

FloatRaster cropped(const FloatRaster& in, int width, int height) {
    FloatRaster out(width, height);
    for (int y = 0; y < height; ++y)
        std::copy(in.row(y), in.row(y) + width, out.row(y));
    return out;
}

cv::Mat view(const FloatRaster& raster) {
    // const_cast: OpenCV has no view of constant data; the plane is only read.
    return {raster.height(), raster.width(), CV_32FC1, const_cast<float*>(raster.data())};
}

cv::Mat twice(const cv::Mat& plane) {
    cv::Mat out;
    cv::resize(plane, out, {plane.cols * 2, plane.rows * 2}, 0, 0, cv::INTER_LINEAR);
    return out;
}

// Free of detail that would come and go with the phase of the level's pixels.
cv::Mat softened(const cv::Mat& plane) {
    cv::Mat out;
    cv::GaussianBlur(plane, out, {3, 3}, 0.85, 0.85, cv::BORDER_REPLICATE);
    return out;
}

FloatRaster with_margin(const cv::Mat& plane) {
    constexpr int m = LightLevel::kMargin;
    FloatRaster out(plane.cols + 2 * m, plane.rows + 2 * m);
    cv::Mat padded(out.height(), out.width(), CV_32FC1, out.data());
    cv::copyMakeBorder(plane, padded, m, m, m, m, cv::BORDER_REPLICATE);
    return out;
}

// Add a quarter of a phase's plane at the place it was cut from.
void add_shifted(const FloatRaster& plane, int dx, int dy, FloatRaster& sum) {
    for (int y = 0; y < sum.height(); ++y) {
        const float* in = plane.row(std::max(0, y - dy));
        float* out = sum.row(y);
        for (int x = 0; x < sum.width(); ++x)
            out[x] += in[std::max(0, x - dx)] / static_cast<float>(kPhases);
    }
}

}  // namespace

Context level_field(const LightLevel& level, const Context& context, const Mlp& mlp) {
    Context field(kChannels, FloatRaster(level.width, level.height));
    const int strips = (level.height + kStripRows - 1) / kStripRows;
    parallel_for_each_index(0, static_cast<std::size_t>(strips), 1, [&](std::size_t i) {
        const int first = static_cast<int>(i) * kStripRows;
        const int last = std::min(level.height, first + kStripRows);
        fill_strip(FeatureStrip(level, context, first, last), mlp, first, last, field);
    });
    return field;
}

Context context_from(const Context& coarse) {
    Context fine;
    for (const auto& plane : coarse)
        fine.push_back(with_margin(twice(view(plane))));
    return fine;
}

Context phase_context(const CoarseLevels& coarse, const FieldModel& model, std::size_t last) {
    Context context;
    for (std::size_t i = kPyramidLevels; i-- > last;) {
        const Context field = level_field(coarse.levels[i - kFineLevels], context, model.levels[i]);
        context.clear();
        for (const auto& plane : field)
            context.push_back(with_margin(twice(softened(view(plane)))));
    }
    return context;
}

Context coarse_context(const LightPyramid& pyramid, const FieldModel& model) {
    std::array<Context, kPhases> phases;
    parallel_for_each_index(0, kPhases, 1, [&](std::size_t i) {
        phases[i] = phase_context(pyramid.coarse[i], model, kFineLevels);
    });
    Context mean;
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
        const FloatRaster& first = phases[0][channel];
        FloatRaster sum(first.width(), first.height());
        for (std::size_t i = 0; i < kPhases; ++i)
            add_shifted(phases[i][channel], pyramid.coarse[i].dx, pyramid.coarse[i].dy, sum);
        mean.push_back(std::move(sum));
    }
    return mean;
}

EdgeField ClassicalEdgeDetector::detect(const Photo& photo) const {
    const LightPyramid pyramid = light_pyramid(photo);
    Context field =
        level_field(pyramid.fine[1], coarse_context(pyramid, *model_), model_->levels[1]);
    field = level_field(pyramid.fine[0], context_from(field), model_->levels[0]);
    return {cropped(field[0], photo.width(), photo.height()),
            cropped(field[1], photo.width(), photo.height()),
            cropped(field[2], photo.width(), photo.height())};
}

}  // namespace scree::vision
