#pragma once

#include "base/options.h"
#include "base/progress.h"
#include "base/raster.h"
#include "base/whole_file.h"
#include "meshing/bake/relief_bake.h"
#include "vision/rock_data.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace scree::apps {

/// What is built from a set of rocks.
struct AssetOptions {
    int max_segments = 30;     ///< Of the largest rock's mesh.
    int weather = 0;           ///< Steps of weathering that round every rock's mesh.
    std::int64_t seed = 1;     ///< Of the scattered patch.
    bool quantise = false;     ///< Pack vertices by KHR_mesh_quantization; patch.glb always is.
    bool msft_lod = false;     ///< Put the levels of detail into rocks.glb with MSFT_lod.
    bool plain_nodes = false;  ///< Write the patch as plain nodes, for viewers without instancing.
    meshing::ReliefOptions relief;  ///< Of the displacement map.
};

template <class Visitor>
void describe(AssetOptions& o, Visitor&& field) {
    field("max-segments", o.max_segments,
          {.min = 3, .max = 720, .help = "segments of the largest rock's mesh"});
    field("weather", o.weather,
          {.min = 0, .max = 1000, .help = "steps of weathering that round the rocks' meshes"});
    field("seed", o.seed, {.min = 0, .max = 9e15, .help = "seed of the scattered patch"});
    field("quantise", o.quantise,
          {.help = "pack vertices of rocks.glb and lods/ with KHR_mesh_quantization"});
    field("msft-lod", o.msft_lod, {.help = "put levels of detail into rocks.glb with MSFT_lod"});
    field("plain-nodes", o.plain_nodes,
          {.help = "write the patch as plain nodes, for viewers without EXT_mesh_gpu_instancing"});
    describe(o.relief, field);
}

/// The photograph that the rocks were found on, as far as it is at hand.
struct RockPicture {
    const Photo* photo = nullptr;  ///< Null leaves out overlay.png, textures and relief.
    FloatRaster boundary = {};     ///< Of its edge field; sharpens the relief. Let go when read.
};

/// What was made and what it took.
struct AssetReport {
    std::vector<std::string> files;     ///< Relative to the folder, in the order of the docs.
    std::vector<std::string> left_out;  ///< Files that need rocks or a photograph, with the reason.
    std::vector<std::pair<std::string, double>> seconds;  ///< Of every step; steps overlap.
    double mesh_seconds = 0.0;                            ///< Outlines to meshes.
    std::size_t n_vertices = 0;                           ///< Of all rocks' meshes.
    std::size_t n_triangles = 0;
};

/// Write everything that is made of rocks into a folder: rocks.json, labels.png, overlay.png,
/// preview.png, rocks.glb, lods/, patch.glb, displacement.exr and .png, normal.png, ao.png,
/// sizes.csv and .png.
///
/// Independent files are made at the same time; the bytes do not depend on the number of threads.
/// The files get their names when the caller commits the batch.
/// @throw InvalidInput  the set breaks check_rock_set(), or the photograph has another size.
/// @throw IoError, InvalidOption, Cancelled
AssetReport write_rock_assets(const vision::RockSet& set, RockPicture picture,
                              const std::filesystem::path& folder, const AssetOptions& options,
                              OutputBatch& batch, Progress* progress = nullptr);

}  // namespace scree::apps
