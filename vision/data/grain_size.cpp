#include "vision/data/grain_size.h"

#include "base/number_text.h"
#include "base/options.h"
#include "base/whole_file.h"
#include "vision/data/metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace scree::vision {
namespace {

std::vector<Grain> measured(const RockSet& set, const GrainSizeOptions& options) {
    std::vector<Grain> grains;
    for (std::size_t i = 0; i < set.rocks.size(); ++i) {
        const Outline& outline = set.rocks[i].outline;
        Grain grain;
        grain.rock = i;
        grain.area_px = outline_area(outline);
        grain.diameter_px = 2.0 * std::sqrt(grain.area_px / std::numbers::pi);
        grain.cut = outline.touches_border;
        if ((options.count_cut_rocks || !grain.cut) && grain.diameter_px >= options.min_diameter_px)
            grains.push_back(grain);
    }
    std::sort(grains.begin(), grains.end(), [](const Grain& a, const Grain& b) {
        return std::tie(a.diameter_px, a.rock) < std::tie(b.diameter_px, b.rock);
    });
    return grains;
}

void accumulate(std::vector<Grain>& grains) {
    double total = 0.0;
    for (const Grain& grain : grains)
        total += grain.area_px;
    double area = 0.0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        area += grains[i].area_px;
        grains[i].finer_by_number = static_cast<double>(i + 1) / static_cast<double>(grains.size());
        grains[i].finer_by_area = i + 1 == grains.size() ? 1.0 : area / total;
    }
}

// Diameter at which the curve by area passes `share`. A rock stands at the middle of its own
// share, so that n equal rocks and one of n times the area are treated alike.
double diameter_by_area(const std::vector<Grain>& grains, double share) {
    double before = 0.0;  // position and diameter of the rock before this one
    double smaller = grains.front().diameter_px;
    double start = 0.0;
    for (const Grain& grain : grains) {
        const double middle = 0.5 * (start + grain.finer_by_area);
        if (middle >= share) {
            const double span = middle - before;
            const double part = span > 0.0 ? (share - before) / span : 1.0;
            return smaller + part * (grain.diameter_px - smaller);
        }
        before = middle;
        smaller = grain.diameter_px;
        start = grain.finer_by_area;
    }
    return smaller;
}

void append_percentiles(std::string& text, std::string_view how, const GrainPercentiles& p,
                        const std::string& unit) {
    const std::pair<const char*, double> rows[] = {{"D16", p.d16}, {"D50", p.d50}, {"D84", p.d84}};
    for (const auto& [name, value] : rows) {
        text += "# ";
        text += name;
        text += how;
        append_number(text, value, 6);
        text += " " + unit + "\n";
    }
}

}  // namespace

GrainSizeCurve grain_size_curve(const RockSet& set, const GrainSizeOptions& options) {
    check(options);
    GrainSizeCurve curve;
    curve.millimetres_per_px = 1000.0 * set.metres_per_pixel;
    curve.grains = measured(set, options);
    accumulate(curve.grains);
    if (curve.grains.empty())
        return curve;
    const double unit = set.metres_per_pixel > 0.0 ? curve.millimetres_per_px : 1.0;
    std::vector<double> sorted;
    for (const Grain& grain : curve.grains)
        sorted.push_back(grain.diameter_px);
    curve.by_number = {unit * percentile(sorted, 16), unit * percentile(sorted, 50),
                       unit * percentile(sorted, 84)};
    curve.by_area = {unit * diameter_by_area(curve.grains, 0.16),
                     unit * diameter_by_area(curve.grains, 0.50),
                     unit * diameter_by_area(curve.grains, 0.84)};
    return curve;
}

std::string sizes_to_csv(const GrainSizeCurve& curve) {
    const bool known = curve.millimetres_per_px > 0.0;
    std::string text;
    append_percentiles(text, " by number: ", curve.by_number, curve.unit());
    append_percentiles(text, " by area: ", curve.by_area, curve.unit());
    text += known ? "rock,diameter_mm,diameter_px,area_px,finer_by_number,finer_by_area,cut\n"
                  : "rock,diameter_px,area_px,finer_by_number,finer_by_area,cut\n";
    for (const Grain& grain : curve.grains) {
        text += std::to_string(grain.rock + 1) + ",";
        if (known) {
            append_number(text, grain.diameter_px * curve.millimetres_per_px, 6);
            text += ',';
        }
        for (const double value :
             {grain.diameter_px, grain.area_px, grain.finer_by_number, grain.finer_by_area}) {
            append_number(text, value, 6);
            text += ',';
        }
        text += grain.cut ? "1\n" : "0\n";
    }
    return text;
}

void write_sizes_csv(const std::filesystem::path& path, const GrainSizeCurve& curve) {
    write_staged_file(path, sizes_to_csv(curve));
}

}  // namespace scree::vision
