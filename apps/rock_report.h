#pragma once

#include "apps/rock_assets.h"
#include "vision/rock_data.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::apps {

/// How one photograph, or one file of rocks, was turned into files.
struct RockReport {
    std::filesystem::path source;
    std::filesystem::path folder;
    std::string error;  ///< Why it failed; empty if it did not.
    int width = 0;
    int height = 0;
    std::size_t n_rocks = 0;
    std::string unit = "px";  ///< Of the percentiles by number.
    double d16 = 0.0;
    double d50 = 0.0;
    double d84 = 0.0;
    double metres_per_pixel = 0.0;  ///< 0 if unknown.
    double read_seconds = 0.0;
    double edge_seconds = 0.0;  ///< The source's three phases: edges, outlines, meshes.
    double outline_seconds = 0.0;
    double refine_seconds = 0.0;
    double file_seconds = 0.0;  ///< Outlines to finished files, meshes among it.
    double total_seconds = 0.0;
    std::optional<double> likeness;  ///< To gravel, 0 to 1; empty if unknown.
    std::string doubt;               ///< Why it does not look like gravel; empty if it does.
    bool extracted = false;          ///< Outlines were found here, not read.
    AssetReport assets;
};

/// Counts and grain sizes of a set into a report.
void note_rocks(const vision::RockSet& set, RockReport& report);

/// A few lines for a person.
std::string report_text(const RockReport& report);

/// All reports as JSON for a machine.
std::string report_json(const std::vector<RockReport>& reports);

}  // namespace scree::apps
