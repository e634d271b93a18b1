#pragma once

// Inside image_io alone; not installed.

#include "base/raster.h"

#include <filesystem>

namespace scree::vision {

/// Write one float channel `Y` as OpenEXR without compression, row by row: relief leaves zip a
/// twentieth to save for ten times the time, and the library would hold the file in memory.
/// @pre   The channel has pixels.
/// @throw IoError  names the path and the reason.
void write_exr(const std::filesystem::path& path, const FloatRaster& channel,
               double metres_per_pixel);

}  // namespace scree::vision
