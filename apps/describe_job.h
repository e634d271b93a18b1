#pragma once

#include "base/options.h"
#include "base/progress.h"
#include "terrain/material/description_map.h"
#include "terrain/material/map_from_ids.h"
#include "terrain/material/map_from_rocks.h"
#include "terrain/material/map_rgba.h"
#include "terrain/material/material_layers.h"
#include "terrain/material/shader_templates.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree::apps {

enum class RgbaExport { None, Rgba8, Rgba16 };
inline constexpr std::string_view kRgbaExportNames[] = {"none", "rgba8", "rgba16"};
constexpr std::span<const std::string_view> names_of(RgbaExport) {
    return kRgbaExportNames;
}

/// What `scree describe` makes.
struct DescribeOptions {
    double cell_size_m = 0.0;  ///< Edge of a map cell; 0: what the files say.
    double width_m = 0.0;      ///< Ground along the photograph's width; 0: what it says itself.
    RgbaExport rgba = RgbaExport::None;
    int bake = 0;           ///< Pixels of the baked set's longer side; 0: none.
    bool shaders = false;   ///< Write the shaders of the map.
    bool channels = false;  ///< Write a picture of every parameter.
};

template <class Visitor>
void describe(DescribeOptions& o, Visitor&& field) {
    field("cell-size-m", o.cell_size_m,
          {.min = 0, .max = 1e6, .unit = "m", .help = "edge of a map cell; 0: as the files say"});
    field("width-m", o.width_m,
          {.min = 0,
           .max = 1e6,
           .unit = "m",
           .help = "ground along the photograph's width; 0 asks the metadata"});
    field("export", o.rgba, {.help = "the published four files too"});
    field("bake", o.bake,
          {.min = 0, .max = 16384, .unit = "px", .help = "bake the textures at this size; 0: not"});
    field("shaders", o.shaders, {.help = "write shaders that blend the textures"});
    field("channels", o.channels, {.help = "write a grey picture of every parameter"});
}

/// Where a map comes from, and where it goes.
struct DescribeJob {
    std::filesystem::path map;            ///< A map in its sound form.
    std::filesystem::path painted;        ///< Picture of ids or of the materials' colours.
    std::filesystem::path labels, photo;  ///< As `scree rocks` wrote and read them.
    std::filesystem::path relief;         ///< Displacement map of `scree rocks`, for the texture.
    std::filesystem::path rules, heights;
    std::filesystem::path picture, id_file;  ///< A map in its published form.
    std::filesystem::path materials;         ///< The table for painted pictures, rules and strokes.
    std::filesystem::path strokes;           ///< Laid over what the others give.
    std::filesystem::path layers;            ///< What lies below the map and mixes with it.
    std::filesystem::path folder;
    DescribeOptions options;
    terrain::PaintOptions paint;
    terrain::RockMapOptions rock;
    terrain::MixOptions mix;
    terrain::ShaderOptions shader;
};

/// What was made.
struct DescribeReport {
    terrain::DescriptionMap map;
    std::vector<std::string> files;  ///< In the folder.
    std::optional<terrain::ConversionReport> imported;
    std::optional<terrain::ConversionReport> exported;
    std::optional<terrain::MixReport> mixed;
    std::size_t n_layers = 0;  ///< That mixed.
};

/// Make the map and write its files, all or none. The mix starts from no steps.
/// @throw InvalidInput, IoError, Cancelled  an input would be overwritten too.
DescribeReport run_describe_job(const DescribeJob& job, Progress* progress = nullptr);

/// A few lines for a person; as JSON for a machine.
std::string describe_text(const DescribeReport& report, const DescribeJob& job);
std::string describe_json(const DescribeReport& report, const DescribeJob& job);

}  // namespace scree::apps
