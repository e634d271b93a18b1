#pragma once

#include "vision/classical/light_pyramid.h"
#include "vision/classical/mlp.h"

#include <array>
#include <span>

namespace scree::vision {

/// The networks that turn a pixel's measured values into boundary, inside and distance, one a
/// pyramid level; each sees what the next coarser one said.
struct FieldModel {
    std::array<Mlp, kPyramidLevels> levels;
};

/// The model that training/train_field.py wrote.
const FieldModel& trained_field_model();

/// Read the networks of all levels, finest first, from read_mlp()'s numbers.
FieldModel read_field_model(std::span<const double> numbers);

/// Read a network from numbers: layer count, then inputs, outputs, weights and biases of each.
/// Advances `numbers` past what was read.
/// @throw InvalidInput  the numbers end too early or name impossible sizes.
Mlp read_mlp(std::span<const double>& numbers);

}  // namespace scree::vision
