#include "apps/photo_job.h"

#include "apps/output_folder.h"
#include "base/stopwatch.h"
#include "base/whole_file.h"
#include "vision/image_io.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;

vision::PhotoFile read_scaled(const PhotoJob& job) {
    vision::PhotoFile file =
        vision::read_photo(job.photo, {.max_pixels = job.max_megapixels * 1e6});
    if (job.width_m > 0.0)
        file.metres_per_pixel = job.width_m / file.pixels.width();
    return file;
}

// Of tcmalloc, if the program is linked with it.
extern "C" void MallocExtension_ReleaseFreeMemory() __attribute__((weak));

// Gives memory back to the system between the stages of a large photograph, whose rasters the
// allocator would keep beside the meshes that follow.
class ThriftyProgress : public Progress {
public:
    explicit ThriftyProgress(Progress* listener) : listener_(listener) {}

    void expect(const Photo& photo) { thrifty_ = photo.size() > kLargePhoto; }

    void report(std::string_view stage, double fraction) override {
        if (thrifty_ && stage != stage_ && MallocExtension_ReleaseFreeMemory != nullptr)
            MallocExtension_ReleaseFreeMemory();
        stage_ = stage;
        if (listener_ != nullptr)
            listener_->report(stage, fraction);
    }

    bool cancelled() const override { return listener_ != nullptr && listener_->cancelled(); }

private:
    static constexpr std::size_t kLargePhoto = 4'000'000;  // pixels
    Progress* listener_;
    std::string stage_;
    bool thrifty_ = false;
};

std::string two_digits(std::size_t number) {
    std::string text = number < 10 ? "0" : "";
    return text += std::to_string(number);
}

void write_stages(const vision::RockExtraction& found, const fs::path& folder, OutputBatch& batch,
                  AssetReport& assets) {
    for (std::size_t i = 0; i < found.stages.size(); ++i) {
        const auto& [name, picture] = found.stages[i];
        const std::string file = "stages/" + two_digits(i + 1) + "_" + name + ".png";
        vision::write_png(batch.stage(folder / file), picture);
        assets.files.push_back(file);
    }
}

}  // namespace

RockReport run_photo_job(const PhotoJob& job, Progress* listener) {
    ThriftyProgress thrifty(listener);
    Progress* const progress = &thrifty;
    Stopwatch all;
    Stopwatch watch;
    RockReport report;
    report.source = job.photo;
    report.folder = job.folder;
    report_progress(progress, "reading", 0.0);
    vision::PhotoFile file = read_scaled(job);
    thrifty.expect(file.pixels);
    check_writable(job.folder);
    report.read_seconds = watch.lap();

    vision::RockExtraction found = vision::extract_rocks(file.pixels, job.extraction, progress);
    found.rocks.image = job.photo.filename().string();
    found.rocks.metres_per_pixel = file.metres_per_pixel;
    report.extracted = true;
    report.doubt = found.likeness.reason;
    report.edge_seconds = found.edge_seconds;
    report.outline_seconds = found.outline_seconds;
    report.refine_seconds = found.refine_seconds;
    watch.lap();

    OutputBatch batch;
    report.assets = write_rock_assets(found.rocks, {&file.pixels, std::move(found.boundary)},
                                      job.folder, job.assets, batch, progress);
    write_stages(found, job.folder, batch, report.assets);
    report_progress(progress, "writing files", 1.0);
    batch.commit();
    remove_stale_files(report.assets, job.folder);
    report.file_seconds = watch.lap();
    note_rocks(found.rocks, report);
    report.total_seconds = all.lap();
    return report;
}

}  // namespace scree::apps
