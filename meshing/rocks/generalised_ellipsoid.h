#pragma once

#include <functional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace scree::meshing {

/// A function of azimuth (0 to 2 pi, in the (x, z) plane from +x towards +z) and elevation (-pi/2
/// to pi/2 from the equator), both in radians; its unit is the surface's.
using AngleFunction = std::function<double(double azimuth, double elevation)>;

/// A function of azimuth alone.
using AzimuthFunction = std::function<double(double azimuth)>;

/// An ellipsoid whose semi-axes are functions of both angles (`rocks-and-deformer.md` eq. 3.2):
/// (f cos az cos el, h sin el, g sin az cos el) about its centre.
struct GeneralisedEllipsoid {
    AngleFunction f;  ///< Along x.
    AngleFunction h;  ///< Along y.
    AngleFunction g;  ///< Along z.
    glm::dvec3 centre{0.0};
};

/// Constant semi-axes along x, y and z (eq. 3.1).
/// @throw InvalidInput  one is not positive and finite.
GeneralisedEllipsoid ellipsoid(glm::dvec3 semi_axes, glm::dvec3 centre = glm::dvec3(0.0));

/// Functions of azimuth alone (eq. 3.4).
GeneralisedEllipsoid ellipsoid_by_azimuth(AzimuthFunction f, AzimuthFunction h, AzimuthFunction g,
                                          glm::dvec3 centre = glm::dvec3(0.0));

/// One radius function and one constant depth (eq. 3.5), the form used for reconstruction; the
/// radii are evenly spaced from azimuth 0 and interpolated linearly.
/// @throw InvalidInput  fewer than 3 radii, or a radius or the depth not positive and finite.
GeneralisedEllipsoid ellipsoid_from_radii(std::span<const float> radii, double depth,
                                          glm::dvec3 centre = glm::dvec3(0.0));

/// Point of the surface.
glm::dvec3 point_on(const GeneralisedEllipsoid& surface, double azimuth, double elevation);

/// Point of the silhouette, (x, z) (eq. 3.3).
glm::dvec2 silhouette_point(const GeneralisedEllipsoid& surface, double azimuth);

/// Outward unit normal by central differences; along y at the poles, where it is not defined by
/// the parameters.
glm::dvec3 normal_on(const GeneralisedEllipsoid& surface, double azimuth, double elevation);

/// Where to look at a surface, and how strictly.
struct RegularityOptions {
    int azimuths = 180;       ///< Places round the equator, half a step off azimuth 0.
    int elevations = 90;      ///< Places from pole to pole, none at a pole.
    double tolerance = 1e-4;  ///< Of slopes and jumps, over the mean semi-axis.
};

/// The six conditions of `rocks-and-deformer.md` A.1, each looked at by itself.
struct RegularityReport {
    bool positive_radii = false;   ///< 1: f > 0 and g > 0.
    bool flat_poles = false;       ///< 2: the gradient of h vanishes at both poles.
    bool positive_depth = false;   ///< 3: h > 0.
    bool periodic = false;         ///< 4: f, g and h meet at azimuth 0 and 2 pi...
    bool differentiable = false;   ///< 4: ...and have one slope on both sides where looked at.
    bool turning_equator = false;  ///< 5: the equator turns one way round the centre.
    bool oriented = false;         ///< 6: X . (dX/del x dX/daz) > 0 everywhere.
    bool radial = false;           ///< f = g = h, which stands in for condition 2.

    /// All six; condition 2 is sufficient only, so a radial surface is let off.
    bool regular() const { return star_shaped() && differentiable && (flat_poles || radial); }
    /// What a closed mesh without folds needs: regular, but for creases.
    bool star_shaped() const {
        return positive_radii && positive_depth && periodic && turning_equator && oriented;
    }
};

/// Check the conditions on a grid. A place where a function is no number breaks all that use it.
/// @throw InvalidOption  fewer than 8 azimuths or 4 elevations, or a tolerance not over 0.
RegularityReport check_regularity(const GeneralisedEllipsoid& surface,
                                  const RegularityOptions& options = {});

}  // namespace scree::meshing
