#pragma once

#include "base/whole_file.h"
#include "terrain/material/description_map.h"

#include <filesystem>

namespace scree::terrain {

/// Read a description map in its sound form from its `materials.json`, or from the folder that
/// holds one; the file names the picture of ids and the EXR of parameters.
/// @throw IoError       a file cannot be read.
/// @throw InvalidInput  names the file and what is wrong: see materials_from_json() and
/// check_map();
///                      a file of materials that names no ids; an EXR with another size or with
///                      channels other than repose, mobility and diffusion.
DescriptionMap read_description_map(const std::filesystem::path& path);

/// Stage `materials.json`, `ids.png` and, where the map has planes, `params.exr` for `folder`. The
/// same map gives the same bytes.
/// @throw IoError, InvalidInput  the map breaks check_map().
void stage_description_map(const DescriptionMap& map, const std::filesystem::path& folder,
                           OutputBatch& batch);

/// The same, written whole or not at all.
void write_description_map(const DescriptionMap& map, const std::filesystem::path& folder);

/// Read an 8-bit grey picture of ids. @throw IoError, InvalidInput  it has other channels.
Raster<std::uint8_t> read_ids(const std::filesystem::path& path);

}  // namespace scree::terrain
