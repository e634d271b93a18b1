#include "vision/classical/mlp.h"

#include "base/simd.h"

#include <algorithm>
#include <cmath>

namespace scree::vision {
namespace {

// Sixteen samples side by side. The lanes of a vector unit never mix, so every build of these
// loops gives the same bits.
using Lanes = float __attribute__((vector_size(64), aligned(4), may_alias));
constexpr int kLanes = 16;
static_assert(kMlpBlock % kLanes == 0);

// kOutputs outputs at a time: each input is loaded once for as many multiply-adds.
template <int kOutputs>
[[gnu::always_inline]] inline void dense_rows(const float* const* in, int n_in,
                                              const float* weights, const float* bias, float* out) {
    for (int first = 0; first < kMlpBlock; first += kLanes) {
        Lanes sum[kOutputs];
        for (int o = 0; o < kOutputs; ++o)
            sum[o] = Lanes{} + bias[o];
        for (int k = 0; k < n_in; ++k) {
            const Lanes x = *reinterpret_cast<const Lanes*>(in[k] + first);
            for (int o = 0; o < kOutputs; ++o)
                sum[o] += weights[o * n_in + k] * x;
        }
        for (int o = 0; o < kOutputs; ++o)
            *reinterpret_cast<Lanes*>(out + o * kMlpBlock + first) = sum[o];
    }
}

SCREE_MULTIVERSION void dense(const DenseLayer& layer, const float* const* in, float* out) {
    const float* weights = layer.weights.data();
    const float* bias = layer.bias.data();
    int o = 0;
    for (; o + 8 <= layer.n_out; o += 8)
        dense_rows<8>(in, layer.n_in, weights + o * layer.n_in, bias + o, out + o * kMlpBlock);
    for (; o < layer.n_out; ++o)
        dense_rows<1>(in, layer.n_in, weights + o * layer.n_in, bias + o, out + o * kMlpBlock);
}

}  // namespace

void evaluate_block(const Mlp& mlp, std::span<const float* const> inputs, int n,
                    std::span<float* const> outputs, MlpScratch& scratch) {
    std::size_t widest = inputs.size();
    for (const auto& layer : mlp.layers)
        widest = std::max(widest, static_cast<std::size_t>(layer.n_out));
    scratch.a.resize(widest * kMlpBlock);
    scratch.b.resize(widest * kMlpBlock);
    std::vector<const float*> in(widest);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        in[i] = inputs[i];
    if (n < kMlpBlock) {  // a short block is copied, so that the loops always run over a full one
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            float* row = scratch.b.data() + i * kMlpBlock;
            std::fill(std::copy(inputs[i], inputs[i] + n, row), row + kMlpBlock, 0.0F);
            in[i] = row;
        }
    }
    float* out = scratch.a.data();
    float* other = scratch.b.data();
    for (std::size_t l = 0; l < mlp.layers.size(); ++l) {
        const DenseLayer& layer = mlp.layers[l];
        dense(layer, in.data(), out);
        if (l + 1 == mlp.layers.size())
            break;
        for (int i = 0; i < layer.n_out * kMlpBlock; ++i)
            out[i] = std::max(out[i], 0.0F);
        for (int o = 0; o < layer.n_out; ++o)
            in[static_cast<std::size_t>(o)] = out + o * kMlpBlock;
        std::swap(out, other);
    }
    for (std::size_t o = 0; o < outputs.size(); ++o)
        for (int i = 0; i < n; ++i)
            outputs[o][i] =
                1.0F / (1.0F + std::exp(-out[o * kMlpBlock + static_cast<std::size_t>(i)]));
}

std::vector<float> evaluate(const Mlp& mlp, std::span<const float> inputs) {
    std::vector<const float*> in(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i)
        in[i] = &inputs[i];
    std::vector<float> result(static_cast<std::size_t>(mlp.n_out()));
    std::vector<float*> out(result.size());
    for (std::size_t o = 0; o < result.size(); ++o)
        out[o] = &result[o];
    MlpScratch scratch;
    evaluate_block(mlp, in, 1, out, scratch);
    return result;
}

}  // namespace scree::vision
