#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/output_folder.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "terrain/material/map_files.h"
#include "terrain/material/map_from_classes.h"
#include "vision/classify/classify_ground.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>

#include <nlohmann/json.hpp>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ClassifyFlags {
    double width_m = 0.0;
};

template <class Visitor>
void describe(ClassifyFlags& o, Visitor&& field) {
    field("width-m", o.width_m,
          {.min = 0, .max = 1e5, .unit = "m", .help = "ground along the photograph's width"});
}

// Steepness of heights over a photograph's pixels, degrees.
FloatRaster slope_of(const FloatRaster& heights, double metres_per_pixel) {
    FloatRaster slope(heights.width(), heights.height());
    const auto between = [&](int x0, int y0, int x1, int y1) {
        const double run = metres_per_pixel * (x1 - x0 + y1 - y0);
        return run > 0.0 ? static_cast<double>(heights(x1, y1) - heights(x0, y0)) / run : 0.0;
    };
    for (int y = 0; y < slope.height(); ++y)
        for (int x = 0; x < slope.width(); ++x) {
            const double along_x =
                between(std::max(x - 1, 0), y, std::min(x + 1, slope.width() - 1), y);
            const double along_y =
                between(x, std::max(y - 1, 0), x, std::min(y + 1, slope.height() - 1));
            slope(x, y) = static_cast<float>(std::atan(std::hypot(along_x, along_y)) * 180.0 /
                                             std::numbers::pi);
        }
    return slope;
}

ordered_json report_of(const vision::GroundRegions& regions, const fs::path& photo,
                       double metres_per_pixel) {
    ordered_json classes = ordered_json::array();
    for (std::size_t c = 0; c < vision::kGroundClasses; ++c)
        classes.push_back(
            {{"id", c}, {"name", vision::kGroundClassNames[c]}, {"share", regions.shares[c]}});
    double confidence = 0.0;
    for (const float value : regions.confidence)
        confidence += static_cast<double>(value);
    return {{"photo", photo.filename().string()},
            {"width", regions.classes.width()},
            {"height", regions.classes.height()},
            {"metres_per_pixel", metres_per_pixel},
            {"pieces", regions.pieces},
            {"mean_confidence", confidence / static_cast<double>(regions.confidence.size())},
            {"classes", classes}};
}

// Every weight with its feature: what the classifier knows.
ordered_json model_json(const vision::GroundModel& model) {
    ordered_json features = ordered_json::array();
    for (std::size_t i = 0; i < vision::kGroundFeatures; ++i) {
        ordered_json linear = ordered_json::object();
        ordered_json square = ordered_json::object();
        for (std::size_t c = 0; c < vision::kGroundClasses; ++c) {
            const std::string name(vision::kGroundClassNames[c]);
            linear[name] = model.weights[c][1 + i];
            square[name] = model.weights[c][1 + vision::kGroundFeatures + i];
        }
        features.push_back({{"name", vision::kGroundFeatureNames[i]},
                            {"mean", model.mean[i]},
                            {"deviation", model.deviation[i]},
                            {"weights", linear},
                            {"square_weights", square}});
    }
    ordered_json constants = ordered_json::object();
    for (std::size_t c = 0; c < vision::kGroundClasses; ++c)
        constants[std::string(vision::kGroundClassNames[c])] = model.weights[c][0];
    return {{"constants", constants}, {"features", features}};
}

void print_report(const ordered_json& report, const fs::path& folder, bool json) {
    if (json) {
        std::cout << report.dump(1) << '\n';
        return;
    }
    std::string shares;
    for (const ordered_json& one : report["classes"]) {
        char text[64];
        std::snprintf(text, sizeof text, "%s%s %.0f %%", shares.empty() ? "" : ", ",
                      one["name"].get<std::string>().c_str(), 100.0 * one["share"].get<double>());
        shares += text;
    }
    std::cout << shares << ": " << folder.string() << '\n';
}

}  // namespace

void run_classify(Arguments& arguments) {
    fs::path photo_path, folder, heights_path;
    ClassifyFlags flags;
    vision::GroundOptions options;
    terrain::ClassMapOptions map_options;
    CommonOptions common;
    arguments.positional("PHOTO", photo_path, "photograph of ground from above");
    arguments.path({"output", 'o', "DIR", "folder for the files", true}, folder);
    arguments.path(
        {"heights", 0, "FILE", "heights of the same ground, as large as the photograph", false},
        heights_path);
    arguments.options(flags);
    arguments.options(options);
    arguments.options(map_options);
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    check_writable(folder);
    const vision::PhotoFile photo = vision::read_photo(photo_path);
    const double scale = flags.width_m > 0.0            ? flags.width_m / photo.pixels.width()
                         : photo.metres_per_pixel > 0.0 ? photo.metres_per_pixel
                                                        : 0.001;
    FloatRaster slope;
    if (!heights_path.empty())
        slope = slope_of(vision::read_heights(heights_path).metres, scale);
    const vision::GroundRegions regions = vision::classify_ground(photo.pixels, options, slope);
    ordered_json report = report_of(regions, photo_path, scale);

    OutputBatch batch;
    vision::write_png(batch.stage(folder / "regions.png"), regions.classes);
    vision::write_png(batch.stage(folder / "overlay.png"),
                      vision::draw_regions(photo.pixels, regions.classes));
    terrain::stage_description_map(terrain::map_from_classes(regions.classes, scale, map_options),
                                   folder, batch);
    ordered_json file = report;
    file["classifier"] = model_json(vision::shipped_ground_model());
    write_staged_file(batch.stage(folder / "classes.json"), file.dump(1) + "\n");
    batch.commit();
    if (!common.quiet)
        print_report(report, folder, common.json);
}

}  // namespace scree::apps
