#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/output_folder.h"
#include "apps/rock_report.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "vision/data/rocks_json.h"
#include "vision/image_io.h"

#include <iostream>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;

RockReport build(const fs::path& rocks, const fs::path& photo, const fs::path& folder,
                 const AssetOptions& options, Progress* progress) {
    Stopwatch all;
    Stopwatch watch;
    RockReport report;
    report.source = rocks;
    report.folder = folder;
    const vision::RockSet set = vision::read_rocks_json(rocks);
    const Photo pixels = photo.empty() ? Photo() : vision::read_photo(photo).pixels;
    report.read_seconds = watch.lap();

    OutputBatch batch;
    report.assets = write_rock_assets(set, {photo.empty() ? nullptr : &pixels}, folder, options,
                                      batch, progress);
    report_progress(progress, "writing files", 1.0);
    batch.commit();
    remove_stale_files(report.assets, folder);
    report.file_seconds = watch.lap();
    note_rocks(set, report);
    report.total_seconds = all.lap();
    return report;
}

}  // namespace

void run_mesh(Arguments& arguments) {
    fs::path rocks;
    fs::path photo;
    fs::path folder;
    AssetOptions options;
    CommonOptions common;
    arguments.positional("ROCKS.json", rocks, "rocks as 'scree rocks' wrote them, perhaps edited");
    arguments.path({"output", 'o', "DIR", "folder for the results", true}, folder);
    arguments.path({"photo", 0, "PHOTO", "photograph for textures and the overlay", false}, photo);
    arguments.options(options);
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    ConsoleProgress progress(talk_for_terminal(common.quiet));
    const RockReport report = build(rocks, photo, folder, options, &progress);
    progress.clear();
    if (common.json)
        std::cout << report_json({report});
    else if (!common.quiet)
        std::cout << report_text(report);
}

}  // namespace scree::apps
