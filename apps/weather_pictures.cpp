#include "apps/weather_pictures.h"

#include "meshing/curvature/curvature_colours.h"
#include "meshing/mesh/bounds.h"
#include "meshing/render/raster_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

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

// Moves the middle of a mesh's base to the origin.
glm::mat4 onto_ground(const meshing::TriMesh& placed) {
    const meshing::Box box = meshing::bounding_box(placed);
    const glm::vec3 middle = 0.5F * (box.min + box.max);
    return glm::translate(glm::mat4(1.0F), -glm::vec3(middle.x, box.min.y, middle.z));
}

// Corners of the upright column that holds a mesh whichever way it is turned. Points without
// triangles are not seen, but the eye stands back for them: so all pictures have one scale.
std::vector<glm::vec3> column_around(const meshing::TriMesh& mesh) {
    const meshing::Box box = meshing::bounding_box(mesh);
    const glm::vec3 middle = 0.5F * (box.min + box.max);
    float reach = 0.0F;
    for (const glm::vec3& p : mesh.positions)
        reach = std::max(reach, glm::distance(glm::vec2(p.x, p.z), glm::vec2(middle.x, middle.z)));
    std::vector<glm::vec3> corners;
    for (const float y : {box.min.y, box.max.y})
        for (int i = 0; i < 4 * kSides; ++i) {
            const double a = 2.0 * std::numbers::pi * i / (4 * kSides);
            corners.emplace_back(middle.x + reach * std::cos(a), y, middle.z + reach * std::sin(a));
        }
    return corners;
}

Photo draw(const WornMesh& worn, const glm::mat4& place, const std::vector<glm::vec3>& frame,
           const meshing::ViewOptions& options) {
    meshing::TriMesh mesh = worn.mesh;
    const bool coloured =
        worn.scaled_curvature.size() == mesh.positions.size() && !worn.scaled_curvature.empty();
    mesh.texcoords.clear();
    if (coloured)
        for (const float h : worn.scaled_curvature)
            mesh.texcoords.emplace_back(0.5F + 0.5F * std::clamp(h, -0.99F, 0.99F), 0.5F);
    for (const glm::vec3& p : frame) {
        mesh.positions.push_back(p);
        if (!mesh.normals.empty())
            mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
        if (!mesh.texcoords.empty())
            mesh.texcoords.emplace_back(0.5F, 0.5F);
    }
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
    return beside(draw(before, place, before.mesh.positions, options),
                  draw(after, place, before.mesh.positions, options));
}

Photo turntable_of(const WornMesh& worn) {
    const glm::mat4 place = onto_ground(worn.mesh);
    const std::vector<glm::vec3> frame = column_around(worn.mesh);
    Photo strip;
    for (int side = 0; side < kSides; ++side) {
        const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
        const glm::mat4 turned =
            glm::rotate(glm::mat4(1.0F), angle, glm::vec3(0.0F, 1.0F, 0.0F)) * place;
        const Photo one = draw(worn, turned, frame, {.width = 240, .azimuth = 0, .elevation = 25});
        strip = side == 0 ? one : beside(strip, one);
    }
    return strip;
}

}  // namespace scree::apps
