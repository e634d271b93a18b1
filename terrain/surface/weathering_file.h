#pragma once

#include "terrain/surface/weathering.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scree::terrain {

/// A number that stands for a mesh and options: a saved state belongs to a run with the same.
std::uint64_t run_key(const meshing::TriMesh& mesh, const WeatheringOptions& options);

/// A state as the bytes of a checkpoint file.
std::string encode_state(const WeatheringState& state, std::uint64_t key);

/// @param name  For messages.
/// @throw InvalidInput  the bytes are no checkpoint, are damaged, or of a run with another key.
WeatheringState decode_state(std::span<const std::uint8_t> bytes, std::uint64_t key,
                             std::string_view name);

}  // namespace scree::terrain
