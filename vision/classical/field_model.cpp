#include "vision/classical/field_model.h"

#include "base/error.h"

#include <algorithm>
#include <iterator>

namespace scree::vision {
namespace {

// Written by vision/training/train_field.py.
constexpr double kFieldNumbers[] = {
#include "vision/classical/field_weights.inc"
};

std::span<const double> take(std::span<const double>& numbers, std::size_t n) {
    if (numbers.size() < n)
        fail<InvalidInput>("the network table ends ", n - numbers.size(), " numbers too early");
    const auto taken = numbers.first(n);
    numbers = numbers.subspan(n);
    return taken;
}

std::size_t take_size(std::span<const double>& numbers) {
    const double size = take(numbers, 1)[0];
    if (!(size >= 1 && size <= 4096))
        fail<InvalidInput>("the network table has a layer of size ", size,
                           ", must be in [1, 4096]");
    return static_cast<std::size_t>(size);
}

}  // namespace

Mlp read_mlp(std::span<const double>& numbers) {
    Mlp mlp;
    mlp.layers.resize(take_size(numbers));
    for (auto& layer : mlp.layers) {
        const std::size_t n_in = take_size(numbers), n_out = take_size(numbers);
        layer.n_in = static_cast<int>(n_in);
        layer.n_out = static_cast<int>(n_out);
        const auto weights = take(numbers, n_in * n_out), bias = take(numbers, n_out);
        const auto narrow = [](double v) { return static_cast<float>(v); };
        std::ranges::transform(weights, std::back_inserter(layer.weights), narrow);
        std::ranges::transform(bias, std::back_inserter(layer.bias), narrow);
    }
    return mlp;
}

FieldModel read_field_model(std::span<const double> numbers) {
    FieldModel model;
    for (auto& level : model.levels)
        level = read_mlp(numbers);
    return model;
}

const FieldModel& trained_field_model() {
    static const FieldModel model = read_field_model(kFieldNumbers);
    return model;
}

}  // namespace scree::vision
