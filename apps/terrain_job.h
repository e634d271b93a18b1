#pragma once

#include "apps/ground_file.h"
#include "base/progress.h"
#include "terrain/prepare/river_bed.h"
#include "terrain/prepare/survey.h"
#include "terrain/prepare/terrain_mesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree::apps {

/// Which axis of a file of points looks up.
enum class PointsUp {
    Auto,  ///< z of LAS, y of PLY, as Scree writes it.
    Y,
    Z,
};
inline constexpr std::string_view kPointsUpNames[] = {"auto", "y", "z"};
constexpr std::span<const std::string_view> names_of(PointsUp) {
    return kPointsUpNames;
}

/// What is done with one ground.
struct TerrainJob {
    std::filesystem::path input;  ///< Height map, or points (.ply, .las).
    std::filesystem::path output;
    std::filesystem::path beds;     ///< Empty cuts none.
    std::filesystem::path picture;  ///< Empty draws none.
    GroundScale scale;              ///< Of a height map.
    PointsUp up = PointsUp::Auto;
    terrain::SurveyOptions survey;
    terrain::TerrainMeshOptions mesh;
};

struct TerrainOutcome {
    bool of_points = false;
    terrain::SurveyReport survey;
    std::size_t n_places = 0;  ///< Sampled.
    std::vector<terrain::BedReport> beds;
    std::size_t n_vertices = 0;
    std::size_t n_triangles = 0;
    double mean_edge = 0.0;  ///< Metres.
};

/// Read a ground, cut its beds and write its mesh, with a picture on request.
/// @throw IoError, InvalidInput, InvalidOption, Cancelled
TerrainOutcome run_terrain_job(const TerrainJob& job, Progress* progress = nullptr);

/// A report for people and one for machines.
std::string terrain_text(const TerrainJob& job, const TerrainOutcome& outcome);
std::string terrain_json(const TerrainJob& job, const TerrainOutcome& outcome);

}  // namespace scree::apps
