#include "apps/describe_job.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "terrain/material/description_picture.h"
#include "terrain/material/layers_json.h"
#include "terrain/material/map_check.h"
#include "terrain/material/map_files.h"
#include "terrain/material/map_rules.h"
#include "terrain/material/materials_json.h"
#include "terrain/material/published_set.h"
#include "terrain/material/strokes.h"
#include "terrain/material/texture_bake.h"
#include "vision/image_io.h"

#include <algorithm>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;
using terrain::DescriptionMap;

constexpr double kSurfaceDepth = 1.0;  // metres; of the one layer that mixes

// Everything that any run writes; what a run has no version of is taken away.
constexpr const char* kAllFiles[] = {
    "params.exr",         "layers.exr",           "map_rgba.png",
    "map_ids.txt",        "ground_albedo.png",    "ground_normal.png",
    "ground_height.exr",  terrain::kFragmentFile, terrain::kEvaluationFile,
    "channel_repose.png", "channel_mobility.png", "channel_diffusion.png"};

/// Collects the files of a run.
struct Output {
    fs::path folder;
    OutputBatch batch;
    std::vector<std::string> files;
    Photo texture;  // of all materials, where one is made
    vision::HeightImage relief;

    fs::path stage(const std::string& name) {
        files.push_back(name);
        return batch.stage(folder / name);
    }
};

terrain::MaterialTable table_of(const DescribeJob& job) {
    if (job.materials.empty())
        fail<InvalidInput>("a table of materials is needed; name one with --materials");
    return terrain::read_materials(job.materials);
}

DescriptionMap painted_map(const DescribeJob& job) {
    const terrain::MaterialTable table = table_of(job);
    const double cell = job.options.cell_size_m > 0.0 ? job.options.cell_size_m : table.cell_size;
    return terrain::read_painted_map(job.painted, table.materials, cell, job.paint);
}

DescriptionMap map_of_rules(const DescribeJob& job) {
    const terrain::MaterialTable table = table_of(job);
    vision::HeightImage heights =
        vision::read_heights(job.heights, {.max_pixels = terrain::kMaxMapCells});
    if (!heights.in_metres)
        fail<InvalidInput>(job.heights.string(),
                           " does not say its heights in metres; write them as float EXR");
    const double cell =
        job.options.cell_size_m > 0.0 ? job.options.cell_size_m : heights.metres_per_pixel;
    if (!(cell > 0.0))
        fail<InvalidInput>(job.heights.string(),
                           " does not say the size of its cells; give it with --cell-size-m");
    const terrain::RuleSet rules = terrain::read_rules(job.rules, table.materials);
    return terrain::map_from_rules({std::move(heights.metres), cell}, rules, table.materials);
}

// The same middle of the displacement map as square_texture() takes of the photograph.
vision::HeightImage square_relief(const DescribeJob& job, const Photo& photo, double scale) {
    const vision::HeightImage relief = vision::read_heights(job.relief);
    const int width = relief.metres.width();
    const int height = relief.metres.height();
    if (width != photo.width() || height != photo.height())
        fail<InvalidInput>(job.relief.string(), " has ", width, " x ", height, " pixels, ",
                           job.photo.string(), " has ", photo.width(), " x ", photo.height());
    if (!relief.in_metres)
        fail<InvalidInput>(job.relief.string(),
                           " does not say its heights in metres; take displacement.exr");
    // Without a scale of its own a pixel counted as a millimetre for `scree rocks`.
    const auto stretched =
        static_cast<float>(relief.metres_per_pixel > 0.0 ? scale / relief.metres_per_pixel : 1.0);
    const int side = std::min(width, height);
    FloatRaster square(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            square(x, y) =
                stretched * relief.metres(x + (width - side) / 2, y + (height - side) / 2);
    return {std::move(square), scale};
}

// The photograph's middle becomes the texture of both materials.
DescriptionMap map_of_rocks(const DescribeJob& job, Output& out) {
    const vision::PhotoFile photo = vision::read_photo(job.photo);
    const LabelMap labels = vision::read_labels(job.labels);
    const double scale = job.options.width_m > 0.0
                             ? job.options.width_m / std::max(1, photo.pixels.width())
                             : photo.metres_per_pixel;
    if (!(scale > 0.0))
        fail<InvalidInput>(job.photo.string(), " does not say its scale; give it with --width-m");
    DescriptionMap map = terrain::map_from_rocks(labels, photo.pixels, scale, job.rock);
    out.texture = terrain::square_texture(photo.pixels);
    vision::write_png(out.stage("texture.png"), out.texture);
    if (!job.relief.empty()) {
        out.relief = square_relief(job, photo.pixels, scale);
        vision::write_heights_exr(out.stage("texture_height.exr"), out.relief);
    }
    for (terrain::Material& material : map.materials) {
        material.textures.albedo = out.folder / "texture.png";
        if (!job.relief.empty())
            material.textures.displacement = out.folder / "texture_height.exr";
        material.textures.size_m = out.texture.width() * scale;
        material.gravel = material.id == terrain::kRockId;
    }
    return map;
}

DescriptionMap imported_map(const DescribeJob& job, DescribeReport& report) {
    const terrain::RgbaMap rgba = terrain::read_rgba_map(job.picture, job.id_file);
    if (!(rgba.ids.cell_size > 0.0 || job.options.cell_size_m > 0.0))
        fail<InvalidInput>(job.id_file.string(),
                           " does not say the size of its cells; give it with --cell-size-m");
    report.imported.emplace();
    return terrain::unpack_map(rgba, job.options.cell_size_m, &*report.imported);
}

DescriptionMap map_of(const DescribeJob& job, DescribeReport& report, Output& out,
                      Progress* progress) {
    if (!job.map.empty()) {
        DescriptionMap map = terrain::read_description_map(job.map);
        map.cell_size = job.options.cell_size_m > 0.0 ? job.options.cell_size_m : map.cell_size;
        return map;
    }
    if (!job.painted.empty())
        return painted_map(job);
    if (!job.labels.empty())
        return map_of_rocks(job, out);
    if (!job.rules.empty())
        return map_of_rules(job);
    if (!job.picture.empty())
        return imported_map(job, report);
    const std::vector<terrain::Material> materials = table_of(job).materials;
    const terrain::StrokeScript script = terrain::read_strokes(job.strokes, materials);
    if (script.width == 0)
        fail<InvalidInput>(job.strokes.string(),
                           " has no ground of its own; give it size, cell_size and ground");
    return terrain::map_from_strokes(script, materials, progress);
}

bool brings_ground(const DescribeJob& job) {
    return job.map.empty() && job.painted.empty() && job.labels.empty() && job.rules.empty() &&
           job.picture.empty();
}

void paint_over(const DescribeJob& job, DescriptionMap& map, Progress* progress) {
    if (job.strokes.empty() || brings_ground(job))
        return;
    const terrain::StrokeScript script = terrain::read_strokes(job.strokes, map.materials);
    if (script.width != 0)
        fail<InvalidInput>(job.strokes.string(),
                           " brings a ground of its own, but there is a map to paint on; take "
                           "size, cell_size and ground out");
    terrain::paint(map, script.strokes, progress);
}

// Channels such as 0.sand: metres of a material in a layer, the uppermost first.
void write_layers(const terrain::MaterialLayers& layers, Output& out) {
    std::vector<vision::NamedPlane> planes;
    for (std::size_t n = 0; n < layers.amounts.size(); ++n)
        for (std::size_t m = 0; m < layers.materials.size(); ++m) {
            const Raster<double>& amounts = layers.amounts[n][m];
            FloatRaster values(amounts.width(), amounts.height());
            std::transform(amounts.begin(), amounts.end(), values.begin(),
                           [](double amount) { return static_cast<float>(amount); });
            planes.push_back(
                {std::to_string(n) + "." + layers.materials[m].name, std::move(values)});
        }
    vision::write_planes_exr(out.stage("layers.exr"), planes);
}

void mix(const DescribeJob& job, DescribeReport& report, Output& out) {
    if (job.mix.steps == 0 && job.layers.empty())
        return;
    terrain::LayerStack stack{{{kSurfaceDepth, {}, {}}}, kSurfaceDepth};
    if (!job.layers.empty())
        stack = terrain::read_layers(job.layers, report.map.materials);
    terrain::MaterialLayers layers = terrain::make_layers(report.map, stack);
    report.mixed = terrain::mix_layers(layers, job.mix);
    report.n_layers = layers.amounts.size();
    report.map = terrain::surface_map(layers, stack.surface_depth_m);
    if (!job.layers.empty())
        write_layers(layers, out);
}

void write_published(const DescribeJob& job, DescribeReport& report, Output& out) {
    const std::vector<std::string> shaders = {terrain::kFragmentFile, terrain::kEvaluationFile};
    if (job.options.rgba != RgbaExport::None) {
        const int bits = job.options.rgba == RgbaExport::Rgba8 ? 8 : 16;
        report.exported =
            terrain::stage_published_set(report.map, bits, out.folder, out.batch, job.shader);
        out.files.insert(out.files.end(), {"map_rgba.png", "map_ids.txt"});
    } else if (job.options.shaders) {
        terrain::stage_shaders(report.map, out.folder, out.batch, job.shader);
    } else {
        return;
    }
    out.files.insert(out.files.end(), shaders.begin(), shaders.end());
}

void write_channels(const DescribeJob& job, const DescriptionMap& map, Output& out) {
    if (!job.options.channels)
        return;
    using terrain::MapChannel;
    vision::write_png(out.stage("channel_repose.png"), channel_picture(map, MapChannel::Repose));
    vision::write_png(out.stage("channel_mobility.png"),
                      channel_picture(map, MapChannel::Mobility));
    vision::write_png(out.stage("channel_diffusion.png"),
                      channel_picture(map, MapChannel::Diffusion));
}

void write_baked(const DescribeJob& job, const DescriptionMap& map, Output& out,
                 Progress* progress) {
    if (job.options.bake == 0)
        return;
    std::vector<terrain::MaterialPictures> pictures;
    for (const terrain::Material& material : map.materials) {
        pictures.emplace_back();
        if (out.texture.empty())
            pictures.back() = terrain::read_material_pictures(material.textures);
        else
            pictures.back() = {out.texture, out.relief.metres, {}};  // temporary names still
    }
    const terrain::BakedGround baked = terrain::bake_textures(
        map, pictures, {.size = job.options.bake, .literal_hat = job.shader.literal_hat}, progress);
    vision::write_png(out.stage("ground_albedo.png"), baked.albedo);
    vision::write_data_png(out.stage("ground_normal.png"), baked.normal);
    vision::write_heights_exr(out.stage("ground_height.exr"), baked.displacement);
}

// All files that were read, and the textures that the map names.
std::vector<fs::path> inputs_of(const DescribeJob& job, const DescriptionMap& map) {
    std::vector<fs::path> inputs = {job.map,     job.painted,   job.labels,  job.photo,
                                    job.relief,  job.rules,     job.heights, job.picture,
                                    job.id_file, job.materials, job.strokes, job.layers};
    if (!job.map.empty() && fs::is_directory(job.map))
        inputs.push_back(job.map / "materials.json");
    if (job.labels.empty())  // else the texture is an output
        for (const terrain::Material& material : map.materials)
            for (const fs::path& texture :
                 {material.textures.albedo, material.textures.displacement,
                  material.textures.normal})
                inputs.push_back(texture);
    return inputs;
}

const fs::path* same_file(const std::vector<fs::path>& inputs, const fs::path& file) {
    std::error_code ignored;
    for (const fs::path& input : inputs)
        if (!input.empty() && fs::equivalent(input, file, ignored))
            return &input;
    return nullptr;
}

void check_inputs_stay(const std::vector<fs::path>& inputs, const Output& out) {
    for (const std::string& name : out.files)
        if (const fs::path* input = same_file(inputs, out.folder / name))
            fail<InvalidInput>("the output would overwrite ", input->string(),
                               "; write into another folder");
}

void remove_stale(const std::vector<fs::path>& inputs, const Output& out) {
    std::error_code ignored;
    for (const char* name : kAllFiles) {
        const bool written = std::find(out.files.begin(), out.files.end(), name) != out.files.end();
        if (!written && same_file(inputs, out.folder / name) == nullptr)
            fs::remove(out.folder / name, ignored);
    }
}

}  // namespace

DescribeReport run_describe_job(const DescribeJob& job, Progress* progress) {
    DescribeReport report;
    Output out{job.folder, {}, {}, {}, {}};
    report.map = map_of(job, report, out, progress);
    paint_over(job, report.map, progress);
    mix(job, report, out);
    terrain::stage_description_map(report.map, out.folder, out.batch);
    out.files.insert(out.files.end(), {"materials.json", "ids.png"});
    const bool planes =
        !report.map.repose.empty() || !report.map.mobility.empty() || !report.map.diffusion.empty();
    if (planes)
        out.files.emplace_back("params.exr");
    vision::write_png(out.stage("description.png"), terrain::description_picture(report.map));
    write_published(job, report, out);
    write_channels(job, report.map, out);
    write_baked(job, report.map, out, progress);
    const std::vector<fs::path> inputs = inputs_of(job, report.map);
    check_inputs_stay(inputs, out);
    stop_if_cancelled(progress, "writing");
    out.batch.commit();
    report.files = out.files;
    remove_stale(inputs, out);
    return report;
}

}  // namespace scree::apps
