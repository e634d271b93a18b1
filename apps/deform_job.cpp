#include "apps/deform_job.h"

#include "apps/output_folder.h"
#include "base/stopwatch.h"
#include "base/whole_file.h"
#include "meshing/gltf/gltf_write.h"
#include "terrain/scene/ground_mesh.h"
#include "terrain/scene/scene_file.h"
#include "terrain/scene/scene_painter.h"
#include "vision/animation_io.h"
#include "vision/image_io.h"

#include <algorithm>
#include <optional>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;
using terrain::Scene;
using terrain::Simulation;

// Half a second of pictures a second of the scene is enough for a glance.
constexpr std::size_t kMostPreviewPictures = 48;
constexpr const char* kSettledFile = "settled.png";

std::string frame_name(int frame) {
    const std::string digits = std::to_string(frame);
    return "frames/" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits +
           ".png";
}

// Mean of the pixels that fall together; the preview need not be sharp.
Photo shrunk(const Photo& photo, int width) {
    if (width >= photo.width())
        return photo;
    const int height = std::max(1, photo.height() * width / photo.width());
    Photo out(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int left = x * photo.width() / width;
            const int right = std::max(left + 1, (x + 1) * photo.width() / width);
            const int top = y * photo.height() / height;
            const int bottom = std::max(top + 1, (y + 1) * photo.height() / height);
            glm::ivec3 sum(0);
            for (int v = top; v < bottom; ++v)
                for (int u = left; u < right; ++u)
                    sum += glm::ivec3(photo(u, v));
            out(x, y) = glm::u8vec3(sum / ((right - left) * (bottom - top)));
        }
    return out;
}

/// The pictures of a run: whole ones go to their files at once, small ones wait for the preview.
class Pictures {
public:
    Pictures(const Scene& scene, const Simulation& simulation, int frames)
        : scene_(scene), painter_(terrain::make_painter(scene, simulation)) {
        const int drawn = (frames + scene.outputs.every - 1) / scene.outputs.every;
        stride_ = std::max<std::size_t>(
            1, (static_cast<std::size_t>(drawn) + kMostPreviewPictures - 1) / kMostPreviewPictures);
    }

    std::string renderer() const { return painter_->renderer(); }

    void draw(const Simulation& simulation, const fs::path& folder, OutputBatch& batch,
              std::vector<std::string>& files) {
        const Photo picture = painter_->draw(simulation);
        files.push_back(frame_name(simulation.frame()));
        vision::write_png(batch.stage(folder / files.back()), picture);
        if (n_drawn_++ % stride_ == 0)
            preview_.push_back(shrunk(picture, scene_.outputs.preview_width));
    }

    void draw_settled(const Simulation& simulation, const fs::path& folder, OutputBatch& batch,
                      std::vector<std::string>& files) {
        files.push_back(kSettledFile);
        vision::write_png(batch.stage(folder / files.back()), painter_->draw(simulation));
    }

    void write_preview(const fs::path& folder, OutputBatch& batch,
                       std::vector<std::string>& files) const {
        const double rate =
            scene_.frame_rate / (scene_.outputs.every * static_cast<double>(stride_));
        files.push_back("preview.gif");
        vision::write_gif(batch.stage(folder / files.back()), preview_, rate);
    }

private:
    const Scene& scene_;
    std::unique_ptr<terrain::ScenePainter> painter_;
    std::vector<Photo> preview_;
    std::size_t stride_ = 1;
    std::size_t n_drawn_ = 0;
};

void write_ground(const Scene& scene, const Simulation& simulation, const fs::path& folder,
                  OutputBatch& batch, std::vector<std::string>& files) {
    const double cell = simulation.base().cell_size;
    files.push_back("ddh.exr");
    vision::write_heights_exr(batch.stage(folder / files.back()),
                              {simulation.ground().displacement(simulation.extent()), cell});
    const terrain::Heightfield ground{simulation.ground().heights(simulation.extent()), cell};
    files.push_back("height.exr");
    vision::write_heights_exr(batch.stage(folder / files.back()), {ground.heights, cell});
    meshing::GltfScene gltf;
    gltf.name = "terrain";
    gltf.meshes.push_back({"terrain", terrain::ground_mesh(ground, scene.outputs.mesh_side)});
    gltf.nodes.push_back({"terrain", 0, {}, {}, {}, {}});
    gltf.texture =
        vision::encode_jpeg(terrain::scene_colours(simulation, scene.outputs.texture_side), 88);
    files.push_back("terrain.glb");
    write_staged_file(batch.stage(folder / files.back()), meshing::encode_glb(std::move(gltf)));
}

// Pictures of an earlier, longer run would be taken for this one's.
void remove_stale_frames(const fs::path& folder, const std::vector<std::string>& files) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder / "frames", ignored)) {
        const std::string name = entry.path().filename().string();
        const bool digits =
            name.size() >= 8 && name.ends_with(".png") &&
            std::all_of(name.begin(), name.end() - 4, [](char c) { return c >= '0' && c <= '9'; });
        if (digits && std::find(files.begin(), files.end(), "frames/" + name) == files.end())
            fs::remove(entry.path(), ignored);
    }
    fs::remove(folder / "frames", ignored);  // stays where something is left in it
    for (const char* name : {"preview.gif", kSettledFile})
        if (std::find(files.begin(), files.end(), name) == files.end())
            fs::remove(folder / name, ignored);
}

}  // namespace

DeformResult run_deform_job(const DeformJob& job, Progress* progress) {
    Stopwatch all;
    report_progress(progress, "reading the scene", 0.0);
    Scene scene = terrain::read_scene(job.scene);
    if (job.frames > 0)
        scene.frames = job.frames;
    check_writable(job.folder);
    Simulation simulation(scene, job.device);
    DeformResult result;
    result.scene = job.scene.filename().string();
    result.width = simulation.extent().width;
    result.height = simulation.extent().height;
    result.cell_size_m = simulation.base().cell_size;
    result.device = simulation.ground().device();
    result.device_reason = simulation.device_reason();
    OutputBatch batch;
    std::optional<Pictures> pictures;
    if (job.pictures) {
        pictures.emplace(scene, simulation, scene.frames);
        result.renderer = pictures->renderer();
    }
    for (int frame = 0; frame < scene.frames; ++frame) {
        report_progress(progress, "deforming", static_cast<double>(frame) / scene.frames);
        FrameTimes times;
        times.report = simulation.step();
        Stopwatch watch;
        if (pictures && (frame % scene.outputs.every == 0 || frame + 1 == scene.frames))
            pictures->draw(simulation, job.folder, batch, result.files);
        times.draw_ms = 1000.0 * watch.lap();
        result.frames.push_back(times);
    }
    if (scene.settle) {
        report_progress(progress, "settling", 0.0);
        result.settled = simulation.settle();
        if (pictures)
            pictures->draw_settled(simulation, job.folder, batch, result.files);
    }
    report_progress(progress, "writing files", 0.0);
    write_ground(scene, simulation, job.folder, batch, result.files);
    if (pictures)
        pictures->write_preview(job.folder, batch, result.files);
    result.volume = simulation.volume();
    result.materials = simulation.material_reports();
    result.objects = simulation.object_reports();
    result.files.push_back("report.json");
    result.seconds = all.lap();
    write_staged_file(batch.stage(job.folder / "report.json"), deform_json(result));
    report_progress(progress, "writing files", 1.0);
    batch.commit();
    remove_stale_frames(job.folder, result.files);
    return result;
}

}  // namespace scree::apps
