#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/console.h"
#include "apps/output_folder.h"
#include "apps/photo_job.h"
#include "base/error.h"
#include "base/parallel.h"

#include <iostream>
#include <vector>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;

RockReport failed(const PhotoJob& job, const std::string& reason) {
    RockReport report;
    report.source = job.photo;
    report.folder = job.folder;
    report.error = reason;
    return report;
}

// One bad photograph never stops the others; a wrong option or Ctrl-C does.
RockReport run_tolerant(const PhotoJob& job, ConsoleProgress& progress) {
    try {
        return run_photo_job(job, &progress);
    } catch (const Cancelled&) {
        throw;
    } catch (const InvalidOption&) {
        throw;
    } catch (const std::bad_alloc&) {
        return failed(job, "cannot work on " + job.photo.string() +
                               ": not enough memory; scale the picture down");
    } catch (const std::exception& error) {
        return failed(job, error.what());
    }
}

std::vector<RockReport> run_jobs(PhotoJob job, const std::vector<fs::path>& photos,
                                 const CommonOptions& common) {
    const std::vector<fs::path> folders = job_folders(photos, job.folder);
    ConsoleProgress progress(talk_for_terminal(common.quiet));
    std::vector<RockReport> reports;
    for (std::size_t i = 0; i < photos.size(); ++i) {
        job.photo = photos[i];
        job.folder = folders[i];
        progress.begin(photos.size() > 1 ? photos[i].filename().string() : "");
        reports.push_back(run_tolerant(job, progress));
        progress.clear();
        const RockReport& report = reports.back();
        if (!report.error.empty())
            print_error_line("scree rocks: " + report.error);
        else if (!common.quiet && !report.doubt.empty())
            print_error_line("scree rocks: warning: " + report.source.string() +
                             " does not look like gravel: " + report.doubt);
        if (report.error.empty() && !common.json && !common.quiet)
            std::cout << report_text(report) << std::flush;
    }
    return reports;
}

}  // namespace

void run_rocks(Arguments& arguments) {
    std::vector<fs::path> photos;
    PhotoJob job;
    CommonOptions common;
    arguments.positional("PHOTO", photos, "photographs: JPEG, PNG, TIFF or what else can be read");
    arguments.path({"output", 'o', "DIR", "folder for the results", true}, job.folder);
    arguments.flag("width-m", job.width_m,
                   {.min = 0,
                    .max = 1e6,
                    .unit = "m",
                    .help = "ground along the photograph's width; 0 asks the metadata"});
    arguments.options(job.extraction);
    arguments.options(job.assets);
    arguments.flag("max-megapixels", job.max_megapixels,
                   {.min = 1e-6, .max = 2000, .help = "larger photographs are refused"});
    arguments.options(common);
    arguments.parse();

    const ThreadLimit limit(common.threads);
    const std::vector<RockReport> reports = run_jobs(job, photos, common);
    if (common.json)
        std::cout << report_json(reports);
    std::size_t n_failed = 0;
    for (const RockReport& report : reports)
        n_failed += report.error.empty() ? 0 : 1;
    if (n_failed > 0 && photos.size() > 1)
        fail<InvalidInput>(n_failed, " of ", photos.size(), " photographs failed");
    if (n_failed > 0)
        throw Reported();
}

}  // namespace scree::apps
