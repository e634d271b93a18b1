#include "vision/learned/outline_network.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "vision/learned/onnx_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <vector>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

namespace scree::vision {
namespace {

constexpr std::size_t kMostBytes = 64U << 20U;
constexpr double kMostBytesAPixel = 4096;

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
    fail<InvalidInput>("cannot use ", name, " as outline network: ", reason,
                       "; expected is an ONNX file as vision/training writes it, with one input "
                       "'picture' (1 x 3 x H x W) and one output 'field' (1 x 4K x H/2 x W/2, K at "
                       "least 3); leave --model out to use the network that is built in");
}

// OpenCV's importer writes to standard error what it throws as well.
class QuietOpenCv {
public:
    QuietOpenCv()
        : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
    ~QuietOpenCv() { cv::utils::logging::setLogLevel(before_); }
    QuietOpenCv(const QuietOpenCv&) = delete;
    QuietOpenCv& operator=(const QuietOpenCv&) = delete;

private:
    cv::utils::logging::LogLevel before_;
};

std::string first_line(const std::string& text) {
    return text.substr(0, std::min(text.find('\n'), std::size_t{200}));
}

template <class Work>
auto with_our_errors(const std::string& name, Work&& work) {
    try {
        const QuietOpenCv quiet;
        return work();
    } catch (const Error& error) {
        refuse(name, error.what());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const cv::Exception& error) {
        refuse(name, "OpenCV cannot run it (" + first_line(error.err) + ")");
    } catch (const std::exception& error) {
        refuse(name, "OpenCV cannot run it (" + first_line(error.what()) + ")");
    }
}

cv::dnn::MatShape output_shape(const cv::dnn::Net& net, int width, int height) {
    std::vector<cv::dnn::MatShape> in, out;
    const int last = net.getUnconnectedOutLayers().at(0);
    net.getLayerShapes(cv::dnn::MatShape{1, 3, height, width}, last, in, out);
    return out.at(0);
}

void check_shapes(const cv::dnn::Net& net) {
    for (const auto& [width, height] : {std::pair{64, 64}, {96, 160}}) {
        const cv::dnn::MatShape shape = output_shape(net, width, height);
        const bool fits = shape.size() == 4 && shape[0] == 1 && shape[1] >= 4 * kFieldChannels &&
                          shape[1] % 4 == 0 && shape[2] == height / 2 && shape[3] == width / 2;
        if (fits)
            continue;
        std::string text;
        for (const int n : shape)
            text += (text.empty() ? "" : " x ") + std::to_string(n);
        fail<InvalidInput>("for a picture of 1 x 3 x ", height, " x ", width, " it gives ", text);
    }
    std::size_t weights = 0, values = 0;
    net.getMemoryConsumption(cv::dnn::MatShape{1, 3, 256, 256}, weights, values);
    const double a_pixel = static_cast<double>(values) / (256.0 * 256.0);
    if (a_pixel > kMostBytesAPixel)
        fail<InvalidInput>("it needs ", std::llround(a_pixel), " bytes a pixel, more than ",
                           kMostBytesAPixel);
}

// Channel 4k + 2i + j of a half-sized picture holds the pixels (2y + i, 2x + j) of channel k.
void unfold_row(const float* even, const float* odd, std::span<float> out) {
    for (std::size_t x = 0; x < out.size() / 2; ++x) {
        out[2 * x] = even[x];
        out[2 * x + 1] = odd[x];
    }
}

}  // namespace

OutlineNetwork::OutlineNetwork(std::string_view onnx, std::string name) : name_(std::move(name)) {
    if (onnx.empty())
        refuse(name_, "it is empty");
    bytes_ = with_our_errors(name_, [&] { return checked_network(onnx); });
}

OutlineNetwork read_network(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        refuse(name, "there is no such file");
    const std::string bytes =
        with_our_errors(name, [&] { return read_whole_file(path, kMostBytes); });
    OutlineNetwork network(bytes, name);
    const NetworkRun trial(network);
    return network;
}

struct NetworkRun::State {
    std::string name;
    cv::dnn::Net net;
};

NetworkRun::NetworkRun(const OutlineNetwork& network)
    : state_(std::make_unique<State>(State{network.name(), {}})) {
    const std::string& bytes = network.bytes();
    with_our_errors(network.name(), [&] {
        state_->net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
        state_->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
        state_->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
        check_shapes(state_->net);
    });
}

NetworkRun::~NetworkRun() = default;

void NetworkRun::evaluate(std::span<const float> input, int width, int height,
                          std::span<float> logits) {
    const auto rows = static_cast<std::size_t>(height);
    const auto columns = static_cast<std::size_t>(width);
    assert(width % kNetworkStep == 0 && height % kNetworkStep == 0);
    assert(input.size() == 3 * rows * columns && logits.size() == kFieldChannels * rows * columns);
    const cv::Mat out = with_our_errors(state_->name, [&] {
        const int shape[] = {1, 3, height, width};
        // const_cast: OpenCV has no view of constant data; it copies the input.
        state_->net.setInput(cv::Mat(4, shape, CV_32F, const_cast<float*>(input.data())));
        return state_->net.forward();
    });
    parallel_for_each_index(0, kFieldChannels * rows, 64, [&](std::size_t i) {
        const int channel = static_cast<int>(4 * (i / rows) + 2 * (i % 2));
        const int y = static_cast<int>(i % rows / 2);
        unfold_row(out.ptr<float>(0, channel, y), out.ptr<float>(0, channel + 1, y),
                   logits.subspan(i * columns, columns));
    });
    for (const float value : logits)
        if (!std::isfinite(value))
            refuse(state_->name, "what it says of the photograph is not a finite number");
}

}  // namespace scree::vision
