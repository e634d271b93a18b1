#pragma once

#include <span>
#include <vector>

namespace scree::vision {

/// One fully connected layer: out = weights * in + bias, weights row by row (one row an output).
struct DenseLayer {
    int n_in = 0;
    int n_out = 0;
    std::vector<float> weights;  ///< n_out x n_in.
    std::vector<float> bias;     ///< n_out.
};

/// A small multi-layer perceptron: rectified hidden layers, logistic outputs in 0..1.
struct Mlp {
    std::vector<DenseLayer> layers;

    int n_in() const { return layers.empty() ? 0 : layers.front().n_in; }
    int n_out() const { return layers.empty() ? 0 : layers.back().n_out; }
};

/// Most samples that evaluate_block() takes at once.
inline constexpr int kMlpBlock = 64;

/// Buffers of evaluate_block(), kept by the caller so that a loop allocates once.
struct MlpScratch {
    std::vector<float> a;
    std::vector<float> b;
};

/// Evaluate the network for `n` neighbouring samples.
///
/// `inputs[i]` points at n consecutive values of input i (structure of arrays), `outputs[o]` at
/// room for n values of output o. The sums run in the order of the inputs whatever n is, so a
/// sample's result does not depend on its place in the block.
///
/// @pre n <= kMlpBlock; as many pointers as the network has inputs and outputs.
void evaluate_block(const Mlp& mlp, std::span<const float* const> inputs, int n,
                    std::span<float* const> outputs, MlpScratch& scratch);

/// The same for one sample.
std::vector<float> evaluate(const Mlp& mlp, std::span<const float> inputs);

}  // namespace scree::vision
