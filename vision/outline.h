#pragma once

#include "base/raster.h"
#include "vision/edge_field.h"

#include <array>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::vision {

inline constexpr int kRadii = 360;  ///< Radii an outline stores, one a degree.

/// A closed outline, star-shaped about its centre, in pixels of the photograph.
///
/// Pixel (x, y) covers [x, x+1) x [y, y+1). Azimuth 0 points along +x (columns) and grows towards
/// +y (rows, which become z in the world).
struct Outline {
    glm::dvec2 centre{0.0};             ///< x = column, y = row.
    std::array<float, kRadii> radii{};  ///< Distance to the border at k degrees; all positive.
    float confidence = 0.0F;            ///< Chance that this is one whole rock, 0 to 1.
    bool touches_border = false;        ///< The photograph's edge cuts the rock.
};

/// A way to turn an edge field into outlines. Finders are exchangeable.
class OutlineFinder {
public:
    virtual ~OutlineFinder() = default;

    /// @pre   Filled channels have the photograph's size.
    /// @post  Outlines are ordered by decreasing confidence, ties by row then column.
    /// @throw InvalidInput  the sizes differ or a channel that the finder needs is empty.
    /// @throw Cancelled     the listener asked for a stop.
    virtual std::vector<Outline> find(const Photo& photo, const EdgeField& field,
                                      Progress* progress = nullptr) const = 0;
};

/// Radius at any azimuth (radians): periodic linear interpolation of the stored radii.
double radius_at(const Outline& outline, double azimuth);

/// Border point at whole degree k, in pixels.
glm::dvec2 border_point(const Outline& outline, int degree);

/// Area of the closed polygon through the border points, square pixels.
double outline_area(const Outline& outline);

/// Diameter of the disc of equal area, pixels.
double equivalent_diameter(const Outline& outline);

/// Paint outlines into a label map: the first gets 1, the second 2 and so on. A pixel belongs to
/// an outline if its centre lies inside; where outlines overlap the earlier one keeps the pixel.
/// @throw InvalidInput  more than 65535 outlines, or an outline with a bad centre or radius.
LabelMap paint_labels(const std::vector<Outline>& outlines, int width, int height);

}  // namespace scree::vision
