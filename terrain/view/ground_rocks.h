#pragma once

#include "terrain/grid/heightfield.h"
#include "terrain/view/terrain_frame.h"

#include <filesystem>

namespace scree::terrain {

/// The rocks of a GLB file, as `scree rocks` and `scree scatter` write them, on a ground: every
/// mesh that the scene shows is one, its origin lies in the middle of the ground.
/// @throw IoError       the file cannot be read.
/// @throw InvalidInput  it is no GLB file or has over 5 million vertices or 10 million triangles.
GroundRocks read_ground_rocks(const std::filesystem::path& file, const Heightfield& ground);

}  // namespace scree::terrain
