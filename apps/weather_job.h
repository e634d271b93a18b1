#pragma once

#include "base/progress.h"
#include "meshing/mesh/cleaning.h"
#include "terrain/surface/weathering.h"

#include <filesystem>
#include <string>

namespace scree::apps {

/// What is done with one mesh.
struct WeatherJob {
    std::filesystem::path mesh;
    std::filesystem::path output;
    std::filesystem::path before_after;  ///< Picture; empty draws none.
    std::filesystem::path turntable;     ///< Picture; empty draws none.
    std::filesystem::path checkpoint;    ///< Kept while the run lasts; empty keeps none.
    std::filesystem::path csv;           ///< A row a step; empty writes none.
    bool csv_times = false;              ///< Milliseconds besides: no two runs are alike then.
    bool curvature_colours = false;      ///< On the output's vertices and in the pictures.
    double save_seconds = 10.0;          ///< Between two checkpoints.
    meshing::CleanOptions clean;
    terrain::WeatheringOptions options;
};

struct WeatherOutcome {
    meshing::CleanReport cleaned;
    terrain::WeatheringReport report;
    std::size_t n_vertices = 0;  ///< In the end.
    std::size_t n_triangles = 0;
    double volume_before = 0.0;  ///< Cubic metres, of a closed mesh.
    double volume_after = 0.0;
    bool resumed = false;
    bool closed = false;
};

/// Read, clean, weather and write a mesh, with its pictures.
///
/// With a checkpoint file the run is saved as it goes on, and a run that was stopped goes on to the
/// same result; a finished one removes the file.
/// @throw IoError, InvalidInput, InvalidOption, Cancelled
WeatherOutcome run_weather_job(const WeatherJob& job, Progress* progress = nullptr);

/// A report for people and one for machines.
std::string weather_text(const WeatherJob& job, const WeatherOutcome& outcome);
std::string weather_json(const WeatherJob& job, const WeatherOutcome& outcome);

}  // namespace scree::apps
