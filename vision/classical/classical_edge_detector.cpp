#include "vision/classical/classical_edge_detector.h"

#include "base/error.h"
#include "base/parallel.h"

#include <array>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

// Strips of a level: more rows waste less on the halo around each, fewer share the work better and
// cost less memory. Neither they nor the thread count change what comes out.
constexpr int kLeastRows = 128;
constexpr int kStripPixels = 1'000'000;
constexpr int kStripsToShare = 4;
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

// Add the share of one phase at the place it was cut from.
void add_shifted(const cv::Mat& plane, const PhasedLevel& phase, float weight, cv::Mat& sum) {
    for (int y = 0; y < sum.rows; ++y) {
        const auto* in = plane.ptr<float>(std::max(0, y - phase.dy));
        auto* out = sum.ptr<float>(y);
        for (int x = 0; x < sum.cols; ++x)
            out[x] += weight * in[std::max(0, x - phase.dx)];
    }
}

}  // namespace

Context level_field(const LightLevel& level, const Context& context, const Mlp& mlp,
                    const Progress* progress) {
    Context field(kChannels, FloatRaster(level.width, level.height));
    const int rows = std::max(
        kLeastRows,
        std::min((level.height + kStripsToShare - 1) / kStripsToShare, kStripPixels / level.width));
    const int n_strips = (level.height + rows - 1) / rows;
    parallel_for_each_index(0, static_cast<std::size_t>(n_strips), 1, [&](std::size_t i) {
        if (progress != nullptr && progress->cancelled())
            fail<Cancelled>("stopped during finding edges");
        const int first = static_cast<int>(i) * rows;
        const int last = std::min(level.height, first + rows);
        fill_strip(FeatureStrip(level, context, first, last), mlp, first, last, field);
    });
    return field;
}

Context context_from(const Context& coarse) {
    Context fine(coarse.size());
    parallel_for_each_index(0, fine.size(), 1,
                            [&](std::size_t i) { fine[i] = with_margin(twice(view(coarse[i]))); });
    return fine;
}

Context coarse_context(const std::vector<PhasedLevel>& phases, const FieldModel& model,
                       std::size_t level) {
    if (phases.empty())
        return {};
    std::vector<Context> fields(phases.size());
    parallel_for_each_index(0, phases.size(), 1, [&](std::size_t i) {
        const Context above = coarse_context(phases[i].coarser, model, level + 1);
        fields[i] = level_field(phases[i].level, above, model.levels[level]);
    });
    const auto weight = 1.0F / static_cast<float>(phases.size());
    Context mean(kChannels);
    parallel_for_each_index(0, kChannels, 1, [&](std::size_t channel) {
        const LightLevel& first = phases[0].level;
        cv::Mat sum = cv::Mat::zeros(2 * first.height, 2 * first.width, CV_32F);
        for (std::size_t i = 0; i < phases.size(); ++i)
            add_shifted(twice(softened(view(fields[i][channel]))), phases[i], weight, sum);
        mean[channel] = with_margin(sum);
    });
    return mean;
}

EdgeField ClassicalEdgeDetector::detect(const Photo& photo, Progress* progress) const {
    LightPyramid pyramid = light_pyramid(photo);
    Context context = coarse_context(pyramid.coarse, *model_, kFineLevels);
    pyramid.coarse.clear();  // a large photograph's planes are let go as soon as they are used up
    context = context_from(level_field(pyramid.fine[1], context, model_->levels[1], progress));
    pyramid.fine[1] = {};
    report_progress(progress, "finding edges", 0.4);
    Context field = level_field(pyramid.fine[0], context, model_->levels[0], progress);
    pyramid.fine[0] = {};
    context.clear();
    parallel_for_each_index(0, field.size(), 1, [&](std::size_t i) {
        if (field[i].width() != photo.width() || field[i].height() != photo.height())
            field[i] = cropped(field[i], photo.width(), photo.height());
    });
    return {std::move(field[0]), std::move(field[1]), std::move(field[2])};
}

}  // namespace scree::vision
