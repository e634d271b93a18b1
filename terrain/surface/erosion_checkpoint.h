#pragma once

#include "terrain/surface/erosion_loop.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// A run as bytes, to be taken up again. `scene` is the text of its scene: a run goes on with no
/// other.
std::vector<std::uint8_t> encode_checkpoint(const ErosionRun& run, std::string_view scene);

/// The run that encode_checkpoint() took down.
/// @throw InvalidInput  the bytes are no checkpoint, are damaged, or belong to another scene; the
///                      message names `source`.
ErosionRun decode_checkpoint(std::span<const std::uint8_t> bytes, std::string_view scene,
                             const std::string& source);

}  // namespace scree::terrain
