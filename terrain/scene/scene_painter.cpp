#include "terrain/scene/scene_painter.h"

#include "meshing/render/raster_view.h"
#include "terrain/material/map_check.h"
#include "terrain/scene/ground_mesh.h"
#include "vision/image_io.h"

#include <algorithm>

#include <glm/ext/matrix_transform.hpp>

namespace scree::terrain {
namespace {

constexpr int kPictureSide = 1024;  // px of the ground's colours
constexpr int kMeshSide = 512;

std::vector<MaterialLook> plain_looks(const DescriptionMap& map) {
    std::vector<MaterialLook> looks;
    for (const Material& m : map.materials) {
        MaterialLook look;
        if (!m.textures.albedo.empty())
            look.albedo = vision::read_photo(m.textures.albedo).pixels;
        look.size_m = m.textures.size_m;
        look.colour = glm::vec3(material_colour(m)) / 255.0F;
        looks.push_back(look);
    }
    return looks;
}

// Draws on the processor, with the renderer that pictures rocks.
class SoftwarePainter : public ScenePainter {
public:
    SoftwarePainter(const Scene& scene, const Simulation& simulation)
        : scene_(&scene), colours_(scene_colours(simulation, kPictureSide)) {}

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

    std::string renderer() const override { return "software"; }

private:
    const Scene* scene_;
    Photo colours_;
};

}  // namespace

std::unique_ptr<ScenePainter> make_painter(const Scene& scene, const Simulation& simulation) {
    return std::make_unique<SoftwarePainter>(scene, simulation);
}

Photo scene_colours(const Simulation& simulation, int side) {
    return ground_picture(simulation.base(), simulation.map(), plain_looks(simulation.map()), side);
}

}  // namespace scree::terrain
