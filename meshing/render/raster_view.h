#pragma once

#include "base/raster.h"
#include "meshing/mesh/tri_mesh.h"

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace scree::meshing {

/// A mesh at a place; the mesh must outlive the view.
struct ViewObject {
    const TriMesh* mesh = nullptr;
    glm::mat4 world_from_object{1.0F};  ///< Rotation, translation and even scaling.
};

/// What a view shows: objects on a rectangle of ground in the plane y = 0 about the origin.
struct ViewScene {
    std::vector<ViewObject> objects;
    const Photo* photo = nullptr;  ///< Looked up by the objects' texture coordinates and laid over
                                   ///< the ground; null draws everything as clay.
    glm::vec2 ground_size{0.0F};   ///< Along x and z, metres; 0 draws no ground.
};

/// Where the eye stands and what the light does. Angles in degrees.
struct ViewOptions {
    int width = 600;                ///< Of one picture, px; the height follows from the scene.
    int supersampling = 2;          ///< Samples along each side of a pixel.
    double azimuth = 24.0;          ///< Of the eye about +y, 0 looks along -z (up the photograph).
    double elevation = 42.0;        ///< Of the eye above the ground.
    double field_of_view = 28;      ///< Across the picture.
    double light_azimuth = -52.0;   ///< Of the key light, measured as the eye's.
    double light_elevation = 38.0;  ///< Of the key light above the ground.
    double photo_on_ground = 0.45;  ///< Brightness of the photograph where no object covers it.
};

template <class Visitor>
void describe(ViewOptions& o, Visitor&& field) {
    field("width", o.width, {.min = 16, .max = 4096, .unit = "px", .help = "width of one picture"});
    field("supersampling", o.supersampling,
          {.min = 1, .max = 4, .help = "samples along each side of a pixel"});
    field("azimuth", o.azimuth,
          {.min = -360, .max = 360, .unit = "deg", .help = "direction the eye looks from"});
    field("elevation", o.elevation,
          {.min = 10, .max = 89, .unit = "deg", .help = "height of the eye above the ground"});
    field("field-of-view", o.field_of_view,
          {.min = 5, .max = 100, .unit = "deg", .help = "angle across the picture"});
    field("light-azimuth", o.light_azimuth,
          {.min = -360, .max = 360, .unit = "deg", .help = "direction the light comes from"});
    field("light-elevation", o.light_elevation,
          {.min = 10, .max = 90, .unit = "deg", .help = "height of the light above the ground"});
    field("photo-on-ground", o.photo_on_ground,
          {.min = 0, .max = 1, .help = "brightness of the photograph between the objects"});
}

/// The same view twice.
struct ViewPictures {
    Photo textured;  ///< Empty where the scene has no photograph.
    Photo clay;      ///< Even grey, so that only the shape speaks.
};

/// Draw a scene in perspective from an eye that is set back until everything is in view.
///
/// Key light with shadows, sky light dimmed in hollows (a height map from above, compared with
/// its own means over two sizes of neighbourhood). Runs in parallel; the same pictures for any
/// number of threads.
/// @throw InvalidOption  a value is outside the range that describe() gives.
/// @throw InvalidInput   nothing to draw, a broken mesh, or more than 2^30 vertices in all.
ViewPictures draw_view(const ViewScene& scene, const ViewOptions& options = {});

/// Two pictures of equal height beside each other, the left one first.
Photo side_by_side(const Photo& left, const Photo& right, int gap = 8);

}  // namespace scree::meshing
