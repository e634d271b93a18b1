#pragma once

#include "vision/data/rocks_json.h"
#include "vision/rock_data.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace scree::vision {

/// The rocks as the source's text record `rockdata 1` (`rocks-and-deformer.md` A.12).
///
/// Nine significant digits whatever the locale: every radius survives, centres are kept to
/// 1e-6 px. The format holds neither confidence, uncertainty nor scale; `params` carries the
/// method. Writing what was read changes no byte.
/// @throw InvalidInput  the set breaks check_rock_set().
std::string rocks_to_text(const RockSet& set);

/// Read what rocks_to_text() writes; numbers of a radii block may be spread over lines.
/// Confidence is 1 and uncertainty 0, for the format has none.
/// @param source  Name of the text in messages, which start `source:line:`.
/// @throw InvalidInput  names the line and what was expected there.
RockSet rocks_from_text(std::string_view text, const std::string& source,
                        const RocksFileLimits& limits = {});

/// @throw IoError, InvalidInput
void write_rocks_text(const std::filesystem::path& path, const RockSet& set);

/// @throw IoError, InvalidInput
RockSet read_rocks_text(const std::filesystem::path& path, const RocksFileLimits& limits = {});

}  // namespace scree::vision
