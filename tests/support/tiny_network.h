#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scree::test {

/// An operator of a network written by hand.
struct TinyNode {
    std::string type;
    std::vector<std::string> inputs;
    std::string output;
    std::vector<std::pair<std::string, std::vector<std::int64_t>>> numbers;  ///< Attributes.
    std::vector<std::pair<std::string, std::string>> words;                  ///< Attributes.
};

/// Weights of a network written by hand.
struct TinyWeights {
    std::string name;
    std::vector<std::int64_t> dims;
    std::vector<float> values;
};

/// A network written by hand, sound or not: what is said here is what stands in the file.
struct TinyNetwork {
    std::vector<TinyNode> nodes;
    std::vector<TinyWeights> weights;
    std::vector<std::string> inputs = {"picture"};
    std::vector<std::string> outputs = {"field"};
    std::vector<std::int64_t> input_dims = {1, 3, 64, 64};
    std::int64_t opset = 11;
};

/// The ONNX file.
std::string onnx_bytes(const TinyNetwork& network);

/// A convolution of 2 x 2 pixels that gives the k-th of `n_channels` channels of the field
/// `gain` times the input's channel k % 3, pixel by pixel, plus k * `step`.
TinyNetwork pointwise_network(int n_channels, float gain, float step);

/// The same after smoothing over (2 * reach + 1)^2 pixels by one convolution.
TinyNetwork smoothing_network(int reach, float gain);

}  // namespace scree::test
