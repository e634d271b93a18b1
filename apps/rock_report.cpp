#include "apps/rock_report.h"

#include "vision/data/grain_size.h"

#include <cstdio>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

using nlohmann::ordered_json;

// Shares of the source's three phases, percent.
struct Split {
    double edges = 0.0;
    double outlines = 0.0;
    double meshes = 0.0;
};

Split split_of(const RockReport& report) {
    const double outlines = report.outline_seconds + report.refine_seconds;
    const double all = report.edge_seconds + outlines + report.assets.mesh_seconds;
    if (all <= 0.0)
        return {};
    return {100.0 * report.edge_seconds / all, 100.0 * outlines / all,
            100.0 * report.assets.mesh_seconds / all};
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

ordered_json sizes_json(const RockReport& report) {
    return {{"unit", report.unit}, {"D16", report.d16}, {"D50", report.d50}, {"D84", report.d84}};
}

ordered_json seconds_json(const RockReport& report) {
    ordered_json steps = ordered_json::object();
    for (const auto& [name, seconds] : report.assets.seconds)
        steps[name] = seconds;
    return {{"read", report.read_seconds},          {"edges", report.edge_seconds},
            {"outlines", report.outline_seconds},   {"refinement", report.refine_seconds},
            {"meshes", report.assets.mesh_seconds}, {"files", report.file_seconds},
            {"total", report.total_seconds},        {"steps", steps}};
}

ordered_json one_json(const RockReport& report) {
    ordered_json one = {{"source", report.source.string()},
                        {"folder", report.folder.string()},
                        {"ok", report.error.empty()}};
    if (!report.error.empty()) {
        one["error"] = report.error;
        return one;
    }
    one["width"] = report.width;
    one["height"] = report.height;
    one["metres_per_pixel"] = report.metres_per_pixel;
    one["rocks"] = report.n_rocks;
    if (report.likeness)
        one["likeness_to_gravel"] = *report.likeness;
    if (!report.doubt.empty())
        one["warning"] = "does not look like gravel: " + report.doubt;
    one["sizes_by_number"] = sizes_json(report);
    one["vertices"] = report.assets.n_vertices;
    one["triangles"] = report.assets.n_triangles;
    one["seconds"] = seconds_json(report);
    if (report.extracted) {
        const Split split = split_of(report);
        one["split_percent"] = {
            {"edges", split.edges}, {"outlines", split.outlines}, {"meshes", split.meshes}};
    }
    one["files"] = report.assets.files;
    one["left_out"] = report.assets.left_out;
    return one;
}

std::string extraction_text(const RockReport& report) {
    const Split split = split_of(report);
    return formatted("  edges %.2f s, outlines %.2f s, meshes %.3f s (%.1f / %.1f / %.1f %%)\n",
                     report.edge_seconds, report.outline_seconds + report.refine_seconds,
                     report.assets.mesh_seconds, split.edges, split.outlines, split.meshes);
}

}  // namespace

void note_rocks(const vision::RockSet& set, RockReport& report) {
    const vision::GrainSizeCurve curve = vision::grain_size_curve(set);
    report.width = set.width;
    report.height = set.height;
    report.n_rocks = set.rocks.size();
    report.likeness = set.likeness;
    report.metres_per_pixel = set.metres_per_pixel;
    report.unit = curve.unit();
    report.d16 = curve.by_number.d16;
    report.d50 = curve.by_number.d50;
    report.d84 = curve.by_number.d84;
}

std::string report_text(const RockReport& report) {
    std::string text = report.source.string() + ": ";
    if (report.n_rocks == 0)
        text += "no rocks found\n";
    else
        text += formatted("%zu %s, D16 %.3g, D50 %.3g, D84 %.3g %s\n", report.n_rocks,
                          report.n_rocks == 1 ? "rock" : "rocks", report.d16, report.d50,
                          report.d84, report.unit.c_str());
    if (report.extracted)
        text += extraction_text(report);
    text += formatted("  %zu files in %.2f s, all of it %.2f s: ", report.assets.files.size(),
                      report.file_seconds, report.total_seconds);
    text += report.folder.string() + "\n";
    for (const std::string& reason : report.assets.left_out)
        text += "  left out " + reason + "\n";
    return text;
}

std::string report_json(const std::vector<RockReport>& reports) {
    ordered_json all = ordered_json::array();
    for (const RockReport& report : reports)
        all.push_back(one_json(report));
    return ordered_json{{"format", "scree-report"}, {"version", 1}, {"photographs", all}}.dump(1) +
           "\n";
}

}  // namespace scree::apps
