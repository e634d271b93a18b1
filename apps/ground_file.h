#pragma once

#include "terrain/grid/heightfield.h"

#include <filesystem>

namespace scree::apps {

/// What a person says of a height map; 0 leaves a value to the file.
struct GroundScale {
    double width_m = 0.0;   ///< Of the ground.
    double height_m = 0.0;  ///< Of white.
};

/// Ground from a height map whose scale the file or a person gives.
/// @throw IoError, InvalidInput  it cannot be read, or its scale is said by nobody or twice.
terrain::Heightfield read_ground(const std::filesystem::path& path, const GroundScale& scale);

}  // namespace scree::apps
