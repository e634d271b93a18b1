#pragma once

#include "terrain/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace scree::terrain {

inline constexpr std::size_t kMaxSceneBytes = std::size_t{4} << 20;
inline constexpr std::size_t kMaxSceneObjects = 256;
inline constexpr std::size_t kMaxMotionKeys = 100'000;

/// Read a scene (docs/scene-files.md). Every member is known, typed and in range; paths are
/// resolved against `folder` and not opened.
/// @param source  Name of the text in messages.
/// @throw InvalidInput  names source and JSON path: no JSON, another format or version, a member
///                      missing, unknown, given twice, of another type or out of range, a material
///                      that is not in the table, an explicit step beyond its stability bound, a
///                      motion whose keys do not follow each other.
Scene scene_from_json(std::string_view text, const std::string& source,
                      const std::filesystem::path& folder);

/// The same from a file; the files that it names must be there.
/// @throw IoError, InvalidInput
Scene read_scene(const std::filesystem::path& path);

}  // namespace scree::terrain
