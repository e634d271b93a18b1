#pragma once

#include "base/progress.h"
#include "terrain/surface/erosion_loop.h"
#include "terrain/surface/erosion_scene.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::apps {

/// What is done with one scene.
struct ErosionJob {
    std::filesystem::path scene;
    std::filesystem::path folder;  ///< Where its files go.
    bool resume = false;           ///< Go on from the folder's checkpoint if it has one.
};

/// What a scene became.
struct ErosionOutcome {
    std::vector<std::string> files;  ///< Relative to the folder.
    std::string resumed;             ///< The checkpoint that it went on from; empty if none.
    std::string repairs;             ///< What was wrong with the mesh file; empty if nothing.
    std::size_t n_vertices = 0;
    std::size_t n_triangles = 0;
    terrain::FluidTally tally;
    terrain::ErosionReport report;
    bool scripted = false;
    terrain::ErosionScheme scheme = terrain::ErosionScheme::Wear;
    double sediment_carried = 0.0;  ///< Cubic metres.
    double sediment_pending = 0.0;
    double sediment_lost = 0.0;
    double sediment_eroded = 0.0;
    double sediment_deposited = 0.0;
};

/// Read the scene, run it and write its files: the mesh, a morph from first to last, pictures, the
/// report, and on request a sequence of meshes, frames of particles and checkpoints. Those of a
/// sequence appear one by one, each whole; the others together at the end.
/// @throw IoError, InvalidInput, InvalidOption, Cancelled
ErosionOutcome run_erosion_job(const ErosionJob& job, Progress* progress = nullptr);

/// A few lines for a person.
std::string erosion_text(const ErosionOutcome& outcome, const std::filesystem::path& folder);

/// The same for a machine: report.json.
std::string erosion_json(const ErosionOutcome& outcome);

}  // namespace scree::apps
