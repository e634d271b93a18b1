#pragma once

#include "base/progress.h"
#include "terrain/scene/simulation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::apps {

/// One run of `scree deform`.
struct DeformJob {
    std::filesystem::path scene;
    std::filesystem::path folder;
    int frames = 0;  ///< 0 takes the scene's.
    bool pictures = true;
    terrain::Device device = terrain::Device::Auto;
};

/// Time of one frame, by stage.
struct FrameTimes {
    terrain::FrameReport report;
    double draw_ms = 0.0;
};

/// What came of it.
struct DeformResult {
    std::string scene;
    int width = 0, height = 0;
    double cell_size_m = 0.0;
    std::string device;         ///< That computed the ground.
    std::string device_reason;  ///< Why that one.
    std::string renderer;       ///< That drew the pictures; empty without any.
    std::vector<FrameTimes> frames;
    std::optional<terrain::SettleReport> settled;  ///< Where the scene asks for it.
    terrain::VolumeReport volume;
    std::vector<terrain::MaterialReport> materials;
    std::vector<terrain::ObjectReport> objects;
    std::vector<std::string> files;  ///< Relative to the folder.
    double seconds = 0.0;
};

/// Run a scene and write its files, all of them or none.
/// @throw IoError, InvalidInput, Cancelled
DeformResult run_deform_job(const DeformJob& job, Progress* progress);

/// report.json. Times are the only numbers in it that differ from run to run.
std::string deform_json(const DeformResult& result);

/// A few lines for a person.
std::string deform_text(const DeformResult& result, const std::filesystem::path& folder);

}  // namespace scree::apps
