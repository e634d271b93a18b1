#include "vision/learned/level_fusion.h"

#include "base/error.h"
#include "base/parallel.h"
#include "vision/classical/field_model.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr int kStripRows = 64;  // a multiple of the coarsest scale's step
constexpr float kMostLogit = 8.0F;

cv::Mat view(const FloatRaster& raster) {
    // const_cast: OpenCV has no view of constant data; the plane is only read.
    return {raster.height(), raster.width(), CV_32FC1, const_cast<float*>(raster.data())};
}

// Rows of a plane of `step` times as coarse a scale, enlarged linearly to the finest one.
cv::Mat enlarged_rows(const FloatRaster& plane, int step, const cv::Rect& wanted) {
    if (step == 1)
        return view(plane)(wanted);
    const int above = wanted.y > 0 ? 1 : 0;  // a row more on either side keeps the seams out
    const int first = wanted.y / step - above;
    const int last = std::min(plane.height(), (wanted.y + wanted.height + step - 1) / step + 1);
    const cv::Mat part = view(plane).rowRange(first, last);
    cv::Mat fine;
    cv::resize(part, fine, {part.cols * step, part.rows * step}, 0, 0, cv::INTER_LINEAR);
    return fine(cv::Rect(0, above * step, wanted.width, wanted.height));
}

// The planes that the model reads and how much coarser than the picture each is.
struct Source {
    const LogitPlanes* planes = nullptr;
    int step = 1;
};

std::vector<Source> sources_of(const LevelStack& stack, const FusionModel& model) {
    std::vector<Source> sources;
    for (int i = 0; i < model.n_levels; ++i) {
        const int halvings = model.reads_doubled ? i - 1 : i;
        if (halvings < 0 && !stack.doubled.empty()) {
            sources.push_back({stack.doubled.data(), 1});
            continue;
        }
        const int there = static_cast<int>(stack.levels.size()) - 1;
        const int level = std::clamp(halvings, 0, there);
        sources.push_back({&stack.levels[static_cast<std::size_t>(level)], 1 << level});
    }
    return sources;
}

void average(std::span<const float* const> inputs, int n, std::span<float* const> outputs) {
    const std::size_t n_levels = inputs.size() / outputs.size();
    for (std::size_t channel = 0; channel < outputs.size(); ++channel) {
        for (int x = 0; x < n; ++x) {
            float sum = 0.0F;
            for (std::size_t level = 0; level < n_levels; ++level)
                sum += inputs[level * outputs.size() + channel][x];
            outputs[channel][x] = 1.0F / (1.0F + std::exp(-sum / static_cast<float>(n_levels)));
        }
    }
}

void fuse_row(const FusionModel& model, std::span<const float* const> inputs, int width,
              std::span<float* const> outputs, MlpScratch& scratch) {
    std::vector<const float*> in(inputs.begin(), inputs.end());
    std::vector<float*> out(outputs.begin(), outputs.end());
    for (int x = 0; x < width; x += kMlpBlock) {
        const int n = std::min(kMlpBlock, width - x);
        if (model.network.layers.empty())
            average(in, n, out);
        else
            evaluate_block(model.network, in, n, out, scratch);
        for (const float*& one : in)
            one += n;
        for (float*& one : out)
            one += n;
    }
}

// The strip of every channel of every scale, at the picture's own size.
std::vector<cv::Mat> strip_rows(const std::vector<Source>& sources, const cv::Rect& strip) {
    std::vector<cv::Mat> rows;
    for (const Source& source : sources) {
        for (const FloatRaster& plane : *source.planes) {
            rows.push_back(enlarged_rows(plane, source.step, strip).clone());
            rows.back() = cv::min(cv::max(rows.back(), -kMostLogit), kMostLogit);
        }
    }
    return rows;
}

std::array<float*, kFieldChannels> field_row(EdgeField& field, int y) {
    return {field.boundary.row(y), field.inside.row(y), field.distance.row(y)};
}

void fuse_strip(const std::vector<Source>& sources, const FusionModel& model, const cv::Rect& strip,
                EdgeField& field) {
    const std::vector<cv::Mat> rows = strip_rows(sources, strip);
    MlpScratch scratch;
    std::vector<const float*> inputs(rows.size());
    for (int y = 0; y < strip.height; ++y) {
        for (std::size_t i = 0; i < rows.size(); ++i)
            inputs[i] = rows[i].ptr<float>(y);
        fuse_row(model, inputs, strip.width, field_row(field, strip.y + y), scratch);
    }
}

template <class Body>
void for_each_strip(int width, int height, Body&& body) {
    const int strips = (height + kStripRows - 1) / kStripRows;
    parallel_for_each_index(0, static_cast<std::size_t>(strips), 1, [&](std::size_t i) {
        const int first = static_cast<int>(i) * kStripRows;
        body(cv::Rect(0, first, width, std::min(kStripRows, height - first)));
    });
}

}  // namespace

FusionModel read_fusion(std::span<const double> numbers) {
    if (numbers.size() < 3)
        fail<InvalidInput>("the fusion table has ", numbers.size(),
                           " numbers, at least 3 are needed");
    FusionModel model;
    model.reads_doubled = numbers[0] != 0.0;
    if (!(numbers[1] >= 1 && numbers[1] <= 4))
        fail<InvalidInput>("the fusion table is of ", numbers[1], " scales, must be in [1, 4]");
    model.n_levels = static_cast<int>(numbers[1]);
    numbers = numbers.subspan(2);
    if (numbers[0] == 0.0)
        return model;
    model.network = read_mlp(numbers);
    for (std::size_t i = 1; i < model.network.layers.size(); ++i)
        if (model.network.layers[i].n_in != model.network.layers[i - 1].n_out)
            fail<InvalidInput>("the layers of the fusion table do not fit each other");
    if (model.network.n_in() != kFieldChannels * model.n_levels ||
        model.network.n_out() != kFieldChannels)
        fail<InvalidInput>("the fusion table has ", model.network.n_in(), " inputs and ",
                           model.network.n_out(), " outputs, must have ",
                           kFieldChannels * model.n_levels, " and ", kFieldChannels);
    return model;
}

const FusionModel& shipped_fusion() {
    static const FusionModel model{.reads_doubled = true, .n_levels = 3};
    return model;
}

EdgeField fuse_levels(LevelStack&& stack, const FusionModel& model) {
    const int width = stack.levels[0][0].width(), height = stack.levels[0][0].height();
    EdgeField field{FloatRaster(width, height), FloatRaster(width, height),
                    FloatRaster(width, height)};
    const std::vector<Source> sources = sources_of(stack, model);
    for_each_strip(width, height,
                   [&](const cv::Rect& strip) { fuse_strip(sources, model, strip, field); });
    return field;
}

}  // namespace scree::vision
