#include "vision/classical/mlp.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

// A deterministic value in [-1, 1) that has no pattern to speak of.
float value_of(unsigned i) {
    return static_cast<float>((i * 2654435761U) >> 8U) / 8388608.0F - 1.0F;
}

Mlp made_up(std::initializer_list<int> sizes) {
    Mlp mlp;
    unsigned counter = 1;
    for (auto at = sizes.begin(); at + 1 != sizes.end(); ++at) {
        DenseLayer layer{at[0], at[1], {}, {}};
        for (int i = 0; i < layer.n_in * layer.n_out; ++i)
            layer.weights.push_back(value_of(counter++));
        for (int i = 0; i < layer.n_out; ++i)
            layer.bias.push_back(value_of(counter++));
        mlp.layers.push_back(layer);
    }
    return mlp;
}

std::vector<double> reference(const Mlp& mlp, std::vector<double> x) {
    for (std::size_t l = 0; l < mlp.layers.size(); ++l) {
        const auto& layer = mlp.layers[l];
        std::vector<double> y;
        for (int o = 0; o < layer.n_out; ++o) {
            double sum = layer.bias[static_cast<std::size_t>(o)];
            for (int i = 0; i < layer.n_in; ++i)
                sum += layer.weights[static_cast<std::size_t>(o * layer.n_in + i)] *
                       x[static_cast<std::size_t>(i)];
            y.push_back(l + 1 < mlp.layers.size() ? std::max(0.0, sum) : 1 / (1 + std::exp(-sum)));
        }
        x = y;
    }
    return x;
}

class MlpBlock : public testing::TestWithParam<int> {};  // the parameter is the block's length

TEST_P(MlpBlock, EqualsThePlainLoop) {
    const int n = GetParam();
    const Mlp mlp = made_up({13, 19, 8, 3});
    std::vector<std::vector<float>> values(13, std::vector<float>(static_cast<std::size_t>(n)));
    std::vector<const float*> inputs;
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t k = 0; k < values[i].size(); ++k)
            values[i][k] = value_of(static_cast<unsigned>(1000 + i * 97 + k));
        inputs.push_back(values[i].data());
    }
    std::vector<std::vector<float>> results(3, std::vector<float>(static_cast<std::size_t>(n)));
    const std::vector<float*> outputs = {results[0].data(), results[1].data(), results[2].data()};
    MlpScratch scratch;

    evaluate_block(mlp, inputs, n, outputs, scratch);

    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
        std::vector<double> x;
        for (const auto& row : values)
            x.push_back(row[k]);
        const auto expected = reference(mlp, x);
        const std::vector<float> alone = evaluate(mlp, std::vector<float>(x.begin(), x.end()));
        for (std::size_t o = 0; o < 3; ++o) {
            EXPECT_NEAR(results[o][k], expected[o], 1e-5);
            EXPECT_EQ(results[o][k], alone[o]) << "the place in the block must not matter";
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Lengths, MlpBlock, testing::Values(1, 3, 16, 17, 63, 64));

}  // namespace
}  // namespace scree::vision
