#include "apps/deform_job.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

using nlohmann::ordered_json;

ordered_json frame_json(const FrameTimes& times) {
    const terrain::FrameReport& r = times.report;
    return {{"substeps", r.substeps},
            {"contact_cells", r.contact_cells},
            {"unspent_force_n", r.unspent_n},
            {"tiles", r.tiles},
            {"ms",
             {{"place", r.place_ms},
              {"contact", r.contact_ms},
              {"step", r.step_ms},
              {"draw", times.draw_ms}}}};
}

double median(std::vector<double> values) {
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double solved_ms(const FrameTimes& times) {
    return times.report.place_ms + times.report.contact_ms + times.report.step_ms;
}

}  // namespace

std::string deform_json(const DeformResult& result) {
    ordered_json frames = ordered_json::array();
    std::vector<double> solved;
    for (const FrameTimes& times : result.frames) {
        frames.push_back(frame_json(times));
        solved.push_back(solved_ms(times));
    }
    ordered_json materials = ordered_json::array();
    for (const terrain::MaterialReport& m : result.materials)
        materials.push_back({{"id", m.id},
                             {"name", m.name},
                             {"repose_deg", m.repose_deg},
                             {"greatest_slope_deg", m.greatest_slope_deg},
                             {"moved_m3", m.moved_m3},
                             {"deepest_m", m.deepest_m},
                             {"highest_m", m.highest_m}});
    ordered_json objects = ordered_json::array();
    for (const terrain::ObjectReport& o : result.objects)
        objects.push_back({{"name", o.name},
                           {"deepest_m", o.deepest_m},
                           {"most_cells", o.most_cells},
                           {"unspent_force_n", o.unspent_n},
                           {"smaller_than_cell", o.smaller_than_cell}});
    const terrain::VolumeReport& v = result.volume;
    ordered_json settled;  // null where the ground was left as the last frame had it
    if (const auto& s = result.settled)
        settled = {{"sweeps", s->sweeps},
                   {"excess_before", s->excess_before},
                   {"excess", s->excess},
                   {"moved_m3", s->moved_m3}};
    const ordered_json report = {
        {"format", "scree-deform-report"},
        {"version", 1},
        {"scene", result.scene},
        {"device", result.device},
        {"device_reason", result.device_reason},
        {"renderer", result.renderer},
        {"ground",
         {{"width", result.width}, {"height", result.height}, {"cell_size_m", result.cell_size_m}}},
        {"volume",
         {{"before_m3", v.before_m3},
          {"after_m3", v.after_m3},
          {"compacted_m3", v.compacted_m3},
          {"moved_m3", v.moved_m3},
          {"relative_drift", v.relative_drift},
          {"drift_of_moved", v.drift_of_moved}}},
        {"settled", settled},
        {"materials", materials},
        {"objects", objects},
        {"median_solve_ms", median(solved)},
        {"seconds", result.seconds},
        {"frames", frames}};
    return report.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string deform_text(const DeformResult& result, const std::filesystem::path& folder) {
    std::vector<double> solved, drawn;
    for (const FrameTimes& times : result.frames) {
        solved.push_back(solved_ms(times));
        if (times.draw_ms > 0.1)
            drawn.push_back(times.draw_ms);
    }
    char line[240];
    std::snprintf(line, sizeof line, "%s: %zu frames of %d x %d cells in %.1f s\n",
                  result.scene.c_str(), result.frames.size(), result.width, result.height,
                  result.seconds);
    std::string text = line;
    std::snprintf(line, sizeof line, "  ground   %s, %.1f ms a frame\n", result.device.c_str(),
                  median(solved));
    text += line;
    if (!result.renderer.empty()) {
        std::snprintf(line, sizeof line, "  pictures %s, %.0f ms each\n", result.renderer.c_str(),
                      median(drawn));
        text += line;
    }
    for (const terrain::MaterialReport& m : result.materials) {
        if (m.moved_m3 <= 0.0)
            continue;
        std::snprintf(line, sizeof line,
                      "  %-8s moved %.4g m3, down to %.3f m, up to %.3f m, steepest %.1f deg "
                      "(repose %.0f)\n",
                      m.name.c_str(), m.moved_m3, m.deepest_m, m.highest_m, m.greatest_slope_deg,
                      m.repose_deg);
        text += line;
    }
    if (result.settled) {
        std::snprintf(line, sizeof line, "  settled  %.4g m3 in %.0f sweeps\n",
                      result.settled->moved_m3, result.settled->sweeps);
        text += line;
    }
    std::snprintf(line, sizeof line, "  volume   drift %.1e of the ground's, %.1e of the moved\n",
                  result.volume.relative_drift, result.volume.drift_of_moved);
    text += line;
    for (const terrain::ObjectReport& o : result.objects)
        if (o.smaller_than_cell)
            text += "  " + o.name + " was smaller than a cell and left no track there\n";
    return text + "  files    " + folder.string() + "\n";
}

}  // namespace scree::apps
