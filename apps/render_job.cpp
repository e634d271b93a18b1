#include "apps/render_job.h"

#include "apps/ground_file.h"
#include "base/whole_file.h"
#include "meshing/gltf/gltf_read.h"
#include "terrain/material/map_files.h"
#include "vision/image_io.h"

#include <utility>

#include <glm/ext/matrix_transform.hpp>

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

// Every mesh that the file's scene shows is a rock; its origin lies in the middle of the ground.
terrain::GroundRocks read_rocks(const std::filesystem::path& file, const Heightfield& ground) {
    meshing::LoadedGltf loaded =
        meshing::read_glb(file, {.max_vertices = 5'000'000, .max_triangles = 10'000'000});
    terrain::GroundRocks rocks;
    for (meshing::GltfMesh& mesh : loaded.meshes)
        rocks.meshes.push_back(std::move(mesh.geometry));
    const glm::dvec3 middle(0.5 * ground.cell_size * ground.heights.width(), 0.0,
                            0.5 * ground.cell_size * ground.heights.height());
    for (const meshing::GltfPlacement& placement : loaded.placements)
        rocks.places.push_back({placement.mesh, glm::mat4(glm::translate(glm::dmat4(1.0), middle) *
                                                          placement.world_from_mesh)});
    return rocks;
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
        shown.rocks = read_rocks(job.rocks, ground);
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
