#include "tests/support/tiny_network.h"

#include "vision/learned/protobuf_wire.h"

#include <cstring>

namespace scree::test {
namespace {

using vision::put_bytes;
using vision::put_varint;

// Field numbers are those of onnx.proto.
std::string written(const TinyNode& node) {
    std::string out;
    for (const std::string& name : node.inputs)
        put_bytes(out, 1, name);
    put_bytes(out, 2, node.output);
    put_bytes(out, 4, node.type);
    for (const auto& [name, numbers] : node.numbers) {
        std::string attribute;
        put_bytes(attribute, 1, name);
        for (const std::int64_t number : numbers)
            put_varint(attribute, 8, static_cast<std::uint64_t>(number));
        put_varint(attribute, 20, 7);
        put_bytes(out, 5, attribute);
    }
    for (const auto& [name, word] : node.words) {
        std::string attribute;
        put_bytes(attribute, 1, name);
        put_bytes(attribute, 4, word);
        put_varint(attribute, 20, 3);
        put_bytes(out, 5, attribute);
    }
    return out;
}

std::string written(const TinyWeights& weights) {
    std::string raw(weights.values.size() * sizeof(float), '\0');
    std::memcpy(raw.data(), weights.values.data(), raw.size());
    std::string out;
    for (const std::int64_t dim : weights.dims)
        put_varint(out, 1, static_cast<std::uint64_t>(dim));
    put_varint(out, 2, 1);
    put_bytes(out, 8, weights.name);
    put_bytes(out, 9, raw);
    return out;
}

std::string written(const std::string& name, const std::vector<std::int64_t>& dims) {
    std::string shape, tensor, type, out;
    for (const std::int64_t dim : dims) {
        std::string one;
        put_varint(one, 1, static_cast<std::uint64_t>(dim));
        put_bytes(shape, 1, one);
    }
    put_varint(tensor, 1, 1);
    put_bytes(tensor, 2, shape);
    put_bytes(type, 1, tensor);
    put_bytes(out, 1, name);
    put_bytes(out, 2, type);
    return out;
}

}  // namespace

std::string onnx_bytes(const TinyNetwork& network) {
    std::string graph;
    for (const TinyNode& node : network.nodes)
        put_bytes(graph, 1, written(node));
    put_bytes(graph, 2, "tiny");
    for (const TinyWeights& weights : network.weights)
        put_bytes(graph, 5, written(weights));
    for (const std::string& name : network.inputs)
        put_bytes(graph, 11, written(name, network.input_dims));
    for (const std::string& name : network.outputs)
        put_bytes(graph, 12, written(name, {}));
    std::string opset, file;
    put_varint(opset, 2, static_cast<std::uint64_t>(network.opset));
    put_varint(file, 1, 6);
    put_bytes(file, 7, graph);
    put_bytes(file, 8, opset);
    return file;
}

TinyNetwork pointwise_network(int n_channels, float gain, float step) {
    const auto n = static_cast<std::size_t>(n_channels);
    TinyWeights weights{"weights", {4 * n_channels, 3, 2, 2}, std::vector<float>(4 * n * 12)};
    TinyWeights bias{"bias", {4 * n_channels}, std::vector<float>(4 * n)};
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t place = 0; place < 4; ++place) {
            weights.values[(4 * k + place) * 12 + k % 3 * 4 + place] = gain;
            bias.values[4 * k + place] = static_cast<float>(k) * step;
        }
    }
    return {{{"Conv",
              {"picture", "weights", "bias"},
              "field",
              {{"kernel_shape", {2, 2}}, {"strides", {2, 2}}},
              {}}},
            {weights, bias}};
}

TinyNetwork smoothing_network(int reach, float gain) {
    const std::int64_t side = 2 * reach + 1;
    const auto area = static_cast<std::size_t>(side * side);
    TinyWeights blur{"blur", {3, 3, side, side}, std::vector<float>(9 * area)};
    for (std::size_t channel = 0; channel < 3; ++channel)
        std::fill_n(blur.values.begin() + static_cast<std::ptrdiff_t>(channel * 4 * area), area,
                    1.0F / static_cast<float>(area));
    TinyNetwork network = pointwise_network(3, gain, 0.0F);
    network.nodes[0].inputs[0] = "smooth";
    network.nodes.insert(network.nodes.begin(),
                         {"Conv",
                          {"picture", "blur"},
                          "smooth",
                          {{"kernel_shape", {side, side}}, {"pads", {reach, reach, reach, reach}}},
                          {}});
    network.weights.push_back(blur);
    return network;
}

}  // namespace scree::test
