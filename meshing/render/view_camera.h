#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// Unit vector towards a place in the sky. Angles in degrees; azimuth 0 is +z, 90 is +x.
glm::vec3 sky_direction(double azimuth, double elevation);

/// A perspective camera and the picture it makes.
struct ViewCamera {
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};  ///< Orthonormal; `back` is to the eye.
    glm::vec3 centre{0.0F};                                ///< What it looks at, metres.
    float distance = 1.0F;                                 ///< Of the eye from the centre, metres.
    glm::vec2 origin{0.0F};  ///< Tangents of the view angles at the picture's top left corner.
    float scale = 1.0F;      ///< Pixels a unit of tangent.
    int width = 1;
    int height = 1;

    /// Pixel coordinates (x, y) and nearness (z): one over the distance along the axis.
    glm::vec3 project(const glm::vec3& point) const;
};

/// Where the camera stands and how wide its picture is.
struct CameraPose {
    int width = 600;              ///< px
    double azimuth = 0.0;         ///< deg
    double elevation = 45.0;      ///< deg
    double field_of_view = 30.0;  ///< deg
};

/// Set the camera back until the points, as far as they lie above y = 0, fill the picture's width;
/// the height follows, up to one and a half widths.
/// @pre  At least one point, all finite.
ViewCamera fit_camera(const std::vector<glm::vec3>& points, const CameraPose& pose);

}  // namespace scree::meshing
