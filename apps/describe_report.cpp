#include "apps/describe_job.h"
#include "terrain/material/description_picture.h"

#include <cstdio>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

using nlohmann::ordered_json;
using terrain::ConversionReport;

template <class... Values>
std::string line(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string loss_text(const char* what, const ConversionReport& report) {
    if (report.exact())
        return std::string(what) + ": nothing was lost\n";
    std::string text = what;
    text += line(": repose within %.2g deg, mobility within %.2g, diffusion within %.2g\n",
                 report.repose_deg, report.mobility, report.diffusion);
    for (const int id : report.without_cells)
        text += line("  not kept: the soil of id %d, which no cell has\n", id);
    for (const std::string& lost : report.lost)
        text += "  not kept: " + lost + "\n";
    return text;
}

ordered_json loss_json(const ConversionReport& report) {
    return {{"exact", report.exact()},
            {"repose_deg", report.repose_deg},
            {"mobility", report.mobility},
            {"diffusion", report.diffusion},
            {"without_cells", report.without_cells},
            {"lost", report.lost}};
}

const char* export_name(const DescribeJob& job) {
    return job.options.rgba == RgbaExport::Rgba8 ? "rgba8" : "rgba16";
}

}  // namespace

std::string describe_text(const DescribeReport& report, const DescribeJob& job) {
    const terrain::DescriptionMap& map = report.map;
    std::string text =
        line("%d x %d cells of %.6g m: ", map.ids.width(), map.ids.height(), map.cell_size) +
        job.folder.string() + "\n";
    const std::vector<double> shares = terrain::material_shares(map);
    const std::vector<glm::u8vec3> legend = terrain::legend_colours(map.materials);
    for (std::size_t i = 0; i < map.materials.size(); ++i) {
        const terrain::Material& material = map.materials[i];
        const glm::u8vec3 colour = legend[i];
        text += line("  %3d  #%02x%02x%02x  %5.1f %%  ", material.id, colour.x, colour.y, colour.z,
                     100.0 * shares[i]);
        text += material.name;
        text += line(": repose %.4g deg, mobility %.4g, diffusion %.4g\n", material.soil.repose_deg,
                     material.soil.mobility, material.soil.diffusion);
    }
    if (report.mixed && report.n_layers > 1)
        for (std::size_t i = 0; i < map.materials.size(); ++i)
            text +=
                line("  %zu layers hold %.6g m3 of ", report.n_layers, report.mixed->after_m3[i]) +
                map.materials[i].name + "\n";
    if (report.imported)
        text += loss_text("import", *report.imported);
    if (report.exported)
        text += loss_text(export_name(job), *report.exported);
    return text;
}

std::string describe_json(const DescribeReport& report, const DescribeJob& job) {
    const terrain::DescriptionMap& map = report.map;
    ordered_json materials = ordered_json::array();
    const std::vector<double> shares = terrain::material_shares(map);
    for (std::size_t i = 0; i < map.materials.size(); ++i)
        materials.push_back(
            {{"id", map.materials[i].id}, {"name", map.materials[i].name}, {"share", shares[i]}});
    ordered_json root = {{"folder", job.folder.string()},
                         {"files", report.files},
                         {"cells", {map.ids.width(), map.ids.height()}},
                         {"cell_size_m", map.cell_size},
                         {"materials", materials}};
    if (report.mixed)
        root["mixed"] = {{"layers", report.n_layers},
                         {"before_m3", report.mixed->before_m3},
                         {"after_m3", report.mixed->after_m3}};
    if (report.imported)
        root["import"] = loss_json(*report.imported);
    if (report.exported)
        root[export_name(job)] = loss_json(*report.exported);
    return root.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace scree::apps
