#include "terrain/scene/scene_painter.h"

#include "meshing/render/raster_view.h"
#include "terrain/scene/ground_mesh.h"
#include "terrain/view/ground_rocks.h"
#include "terrain/view/terrain_view.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

constexpr int kPictureSide = 1024;  // px of the ground's colours
constexpr int kMeshSide = 512;

// Draws on the processor, with the renderer that pictures rocks.
class SoftwarePainter : public ScenePainter {
public:
    SoftwarePainter(const Scene& scene, const Simulation& simulation, std::string reason)
        : scene_(&scene),
          reason_(std::move(reason)),
          colours_(scene_colours(simulation, kPictureSide)) {}

    Photo draw(const Simulation& simulation) override {
        const Heightfield ground{simulation.ground().heights(simulation.extent()),
                                 simulation.base().cell_size};
        const meshing::TriMesh mesh = ground_mesh(ground, kMeshSide);
        const double lowest = *std::min_element(ground.heights.begin(), ground.heights.end());
        const glm::dmat4 centred = glm::translate(
            glm::dmat4(1.0), -glm::dvec3(0.5 * ground.cell_size * ground.heights.width(), lowest,
                                         0.5 * ground.cell_size * ground.heights.height()));
        meshing::ViewScene view;
        view.photo = &colours_;
        view.objects.push_back({&mesh, glm::mat4(centred)});
        for (const PlacedObject& placed : simulation.objects())
            if (placed.present)
                view.objects.push_back({placed.mesh, glm::mat4(centred * placed.world_from_mesh)});
        const SceneCamera& camera = scene_->camera;
        return meshing::draw_view(view, {.width = scene_->outputs.picture_width,
                                         .azimuth = camera.azimuth_deg,
                                         .elevation = std::max(10.0, camera.elevation_deg),
                                         .light_azimuth = camera.light_azimuth_deg,
                                         .light_elevation = camera.light_elevation_deg})
            .textured;
    }

    std::string renderer() const override { return "software (" + reason_ + ")"; }

private:
    const Scene* scene_;
    std::string reason_;
    Photo colours_;
};

// The eye that the scene names, or one from which the whole ground is seen.
TerrainCamera camera_of(const Scene& scene, const Simulation& simulation) {
    const SceneCamera& wanted = scene.camera;
    TerrainCamera camera;
    if (wanted.eye_m) {
        camera = {glm::vec3(*wanted.eye_m), glm::vec3(*wanted.target_m)};
    } else {
        const double aspect =
            static_cast<double>(scene.outputs.picture_width) / scene.outputs.picture_height;
        camera = camera_over(simulation.base(), wanted.azimuth_deg, wanted.elevation_deg, aspect);
        const double nearer = std::tan(glm::radians(0.5 * camera.field_of_view_deg)) /
                              std::tan(glm::radians(0.5 * wanted.field_of_view_deg));
        camera.eye = camera.target + static_cast<float>(nearer) * (camera.eye - camera.target);
    }
    camera.field_of_view_deg = wanted.field_of_view_deg;
    return camera;
}

// Draws with OpenGL: tessellated, displaced, shadowed.
class GlPainter : public ScenePainter {
public:
    GlPainter(const Scene& scene, const Simulation& simulation, std::unique_ptr<GlContext> context)
        : context_(std::move(context)),
          view_(*context_, ground_of(scene, simulation), options_of(scene)) {
        const SceneCamera& camera = scene.camera;
        frame_.camera = camera_of(scene, simulation);
        frame_.light.azimuth_deg = camera.light_azimuth_deg;
        frame_.light.elevation_deg = camera.light_elevation_deg;
    }

    Photo draw(const Simulation& simulation) override {
        const FloatRaster moved = simulation.ground().displacement(simulation.extent());
        frame_.displacement = &moved;
        frame_.objects.clear();
        for (const PlacedObject& placed : simulation.objects())
            if (placed.present)
                frame_.objects.push_back({placed.mesh, glm::mat4(placed.world_from_mesh),
                                          glm::vec3(placed.object->colour)});
        return view_.draw(frame_);
    }

    std::string renderer() const override { return context_->device(); }

private:
    static TerrainGround ground_of(const Scene& scene, const Simulation& simulation) {
        TerrainGround ground{
            &simulation.base(), &simulation.map(), load_looks(simulation.map()), {}};
        if (!scene.rocks.file.empty())
            ground.rocks = read_ground_rocks(scene.rocks.file, simulation.base());
        return ground;
    }
    static TerrainViewOptions options_of(const Scene& scene) {
        return {.width = scene.outputs.picture_width,
                .height = scene.outputs.picture_height,
                .near_m = scene.rocks.near_m};
    }

    std::unique_ptr<GlContext> context_;  // outlives the view
    TerrainView view_;
    TerrainFrame frame_;
};

}  // namespace

std::unique_ptr<ScenePainter> make_painter(const Scene& scene, const Simulation& simulation) {
    GlContext::Attempt attempt = GlContext::try_make();
    if (attempt.context == nullptr)
        return std::make_unique<SoftwarePainter>(scene, simulation, attempt.reason);
    try {
        return std::make_unique<GlPainter>(scene, simulation, std::move(attempt.context));
    } catch (const DeviceError& error) {
        return std::make_unique<SoftwarePainter>(scene, simulation, error.what());
    }
}

Photo scene_colours(const Simulation& simulation, int side) {
    return ground_picture(simulation.base(), simulation.map(), load_looks(simulation.map()), side);
}

}  // namespace scree::terrain
