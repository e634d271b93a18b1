#pragma once

#include "apps/rock_assets.h"
#include "apps/rock_report.h"
#include "base/progress.h"
#include "vision/rock_extraction.h"

#include <filesystem>

namespace scree::apps {

/// What is done with one photograph.
struct PhotoJob {
    std::filesystem::path photo;
    std::filesystem::path folder;  ///< Where its files go.
    vision::ExtractionOptions extraction;
    AssetOptions assets;
    double width_m = 0.0;         ///< Ground along the photograph's width, metres; 0 if unknown.
    double max_megapixels = 200;  ///< Larger photographs are refused.
};

/// Photograph to all files, all or none of them. Files of an earlier run that this one has no
/// version of are removed from the folder.
/// @throw IoError, InvalidInput, InvalidOption, Cancelled
RockReport run_photo_job(const PhotoJob& job, Progress* progress = nullptr);

}  // namespace scree::apps
