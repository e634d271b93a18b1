#pragma once

#include "base/raster.h"

#include <filesystem>
#include <span>

namespace scree::vision {

/// Write an animated GIF that repeats for ever; every picture gets a palette of its own.
/// @throw InvalidInput  no picture, pictures of different sizes, or a rate that is not positive.
/// @throw IoError       names the path and the reason.
void write_gif(const std::filesystem::path& path, std::span<const Photo> pictures,
               double frames_per_second);

}  // namespace scree::vision
