#pragma once

#include "apps/rock_assets.h"

#include <filesystem>
#include <vector>

namespace scree::apps {

/// A folder for each photograph: `folder` itself for one, else one below it named after each
/// without its ending; equal names get -2, -3 and so on in the order given.
std::vector<std::filesystem::path> job_folders(const std::vector<std::filesystem::path>& photos,
                                               const std::filesystem::path& folder);

/// Throw IoError if nothing can be written into the folder, before any work is done.
void check_writable(const std::filesystem::path& folder);

/// Remove the files of earlier runs that a finished one has no version of.
void remove_stale_files(const AssetReport& assets, const std::filesystem::path& folder);

}  // namespace scree::apps
