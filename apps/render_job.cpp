#include "apps/render_job.h"

#include "apps/ground_file.h"
#include "base/whole_file.h"
#include "terrain/material/map_files.h"
#include "terrain/view/ground_rocks.h"
#include "vision/image_io.h"

#include <utility>

namespace scree::apps {
namespace {

using terrain::Heightfield;

FloatRaster read_displacement_of(const RenderJob& job, const Heightfield& ground) {
    if (job.displacement.empty())
        return {};
    vision::HeightImage image = vision::read_heights(job.displacement);
    if (!image.in_metres)
        fail<InvalidInput>(job.displacement.string(),
                           " does not say its heights in metres; write them as float EXR");
    if (image.metres.width() != ground.heights.width() ||
        image.metres.height() != ground.heights.height())
        fail<InvalidInput>(job.displacement.string(), " has ", image.metres.width(), " x ",
                           image.metres.height(), " cells, ", job.heights.string(), " has ",
                           ground.heights.width(), " x ", ground.heights.height());
    return std::move(image.metres);
}

terrain::TerrainFrame frame_of(const RenderJob& job, const Heightfield& ground) {
    terrain::TerrainFrame frame;
    frame.camera = terrain::camera_over(ground, job.options.azimuth, job.options.elevation,
                                        static_cast<double>(job.view.width) / job.view.height);
    frame.camera.eye = frame.camera.target + (frame.camera.eye - frame.camera.target) /
                                                 static_cast<float>(job.options.zoom);
    frame.light.azimuth_deg = job.options.light_azimuth;
    frame.light.elevation_deg = job.options.light_elevation;
    return frame;
}

}  // namespace

std::string run_render_job(const RenderJob& job) {
    const Heightfield ground =
        read_ground(job.heights, {job.options.width_m, job.options.height_m});
    const FloatRaster displacement = read_displacement_of(job, ground);
    terrain::DescriptionMap map;
    terrain::TerrainGround shown;
    shown.base = &ground;
    if (!job.map.empty()) {
        map = terrain::read_description_map(job.map);
        shown.map = &map;
        shown.looks = terrain::load_looks(map);
    }
    if (!job.rocks.empty())
        shown.rocks = terrain::read_ground_rocks(job.rocks, ground);
    const auto context = terrain::GlContext::make({.software = job.software});
    terrain::TerrainView view(*context, shown, job.view);
    terrain::TerrainFrame frame = frame_of(job, ground);
    if (!displacement.empty())
        frame.displacement = &displacement;
    OutputBatch batch;
    vision::write_png(batch.stage(job.output), view.draw(frame, job.options.view));
    batch.commit();
    return context->device();
}

}  // namespace scree::apps
