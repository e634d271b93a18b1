#pragma once

#include "vision/rock_data.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace scree::vision {

/// What a file of rocks may hold before it is refused. All are checked before memory is taken.
struct RocksFileLimits {
    std::size_t max_bytes = std::size_t{512} << 20;  ///< Length of the file.
    double max_pixels = 200e6;                       ///< Width times height of the photograph.
};

inline constexpr std::size_t kMaxRocks = 65535;      ///< As many as a label map can tell apart.
inline constexpr double kMaxCoordinate = 1e6;        ///< Of centres, radii and depths, px.
inline constexpr std::size_t kMaxNameLength = 1024;  ///< Bytes of `image` and of `method`.

/// Check what every file of rocks promises: a size of at least 1 x 1 px, at most kMaxRocks rocks,
/// finite centres, positive radii and depths, confidence in [0, 1], uncertainty of at least 0.
/// @throw InvalidInput  names `source` and the member, such as `rocks[3].radii[17]`.
void check_rock_set(const RockSet& set, std::string_view source,
                    const RocksFileLimits& limits = {});

/// The rocks as text in the format `scree-rocks` (docs/rocks-json.md): version 2 if their likeness
/// to gravel is known, else version 1.
///
/// Numbers have the shortest form that reads back as the same value, a rock is a line; so equal
/// sets give equal bytes, and reading and writing again changes none.
/// @throw InvalidInput  the set breaks check_rock_set().
std::string rocks_to_json(const RockSet& set);

/// Read what rocks_to_json() writes; members may come in any order and with any spacing.
/// @param source  Name of the text in messages.
/// @throw InvalidInput  names source and member: no JSON, another format or version, a member
///                      missing, unknown, given twice, of another type or out of range.
RockSet rocks_from_json(std::string_view text, const std::string& source,
                        const RocksFileLimits& limits = {});

/// @throw IoError, InvalidInput
void write_rocks_json(const std::filesystem::path& path, const RockSet& set);

/// @throw IoError, InvalidInput
RockSet read_rocks_json(const std::filesystem::path& path, const RocksFileLimits& limits = {});

}  // namespace scree::vision
