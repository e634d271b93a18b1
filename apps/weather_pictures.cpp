#include "apps/weather_pictures.h"

#include "meshing/curvature/curvature_colours.h"
#include "meshing/mesh/bounds.h"
#include "meshing/render/raster_view.h"

#include <algorithm>

#include <glm/ext/matrix_transform.hpp>

namespace scree::apps {
namespace {

constexpr int kColours = 256;
constexpr int kSides = 8;

// The ramp of curvature as a picture one pixel high: -1 on the left, +1 on the right.
Photo colour_ramp() {
    Photo ramp(kColours, 1);
    for (int i = 0; i < kColours; ++i)
        ramp.data()[i] = meshing::curvature_colour(
            2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(kColours) - 1.0F);
    return ramp;
}

// Set on the ground as `placed` stands there.
glm::mat4 onto_ground(const meshing::TriMesh& placed) {
    const meshing::Box box = meshing::bounding_box(placed);
    const glm::vec3 middle = 0.5F * (box.min + box.max);
    return glm::translate(glm::mat4(1.0F), -glm::vec3(middle.x, box.min.y, middle.z));
}

Photo draw(const WornMesh& worn, const glm::mat4& place, const meshing::ViewOptions& options) {
    meshing::TriMesh mesh = worn.mesh;
    const bool coloured =
        worn.scaled_curvature.size() == mesh.positions.size() && !worn.scaled_curvature.empty();
    mesh.texcoords.clear();
    if (coloured)
        for (const float h : worn.scaled_curvature)
            mesh.texcoords.emplace_back(0.5F + 0.5F * std::clamp(h, -0.99F, 0.99F), 0.5F);
    const Photo ramp = colour_ramp();
    meshing::ViewScene scene;
    scene.objects.push_back({&mesh, place});
    if (coloured)
        scene.photo = &ramp;
    meshing::ViewPictures view = meshing::draw_view(scene, options);
    return coloured ? std::move(view.textured) : std::move(view.clay);
}

Photo cropped(const Photo& photo, int height) {
    Photo result(photo.width(), height);
    const auto n = result.size();
    std::copy_n(photo.data() + (photo.size() - n), n, result.data());
    return result;
}

// Pictures of one height: what is higher loses its top.
Photo beside(const Photo& left, const Photo& right) {
    const int height = std::min(left.height(), right.height());
    return meshing::side_by_side(cropped(left, height), cropped(right, height));
}

}  // namespace

Photo before_and_after(const WornMesh& before, const WornMesh& after) {
    const glm::mat4 place = onto_ground(before.mesh);
    const meshing::ViewOptions options{.elevation = 25};
    return beside(draw(before, place, options), draw(after, place, options));
}

Photo turntable_of(const WornMesh& worn) {
    const glm::mat4 place = onto_ground(worn.mesh);
    Photo strip;
    for (int side = 0; side < kSides; ++side) {
        const Photo one = draw(worn, place,
                               {.width = 240,
                                .azimuth = 360.0 * side / kSides,
                                .elevation = 25,
                                .light_azimuth = 360.0 * side / kSides - 52.0});
        strip = side == 0 ? one : beside(strip, one);
    }
    return strip;
}

}  // namespace scree::apps
