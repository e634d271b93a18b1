#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace scree::test {

/// Bytes of every file below a folder, by its path relative to it. Empty if there is no folder.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

/// A made-up photograph of rocks as a PNG file; the same bytes for the same arguments.
void write_test_photo(const std::filesystem::path& path, int width, int height, unsigned seed = 1);

}  // namespace scree::test
