#pragma once

#include <span>
#include <vector>

namespace scree::meshing {

/// How the radius of a segment is read from the radii of an outline.
enum class RadiusSampling {
    Point,     ///< Linear interpolation at the segment's azimuth, as the source does.
    Averaged,  ///< Mean over the segment: smoother, but it cuts corners off; better from 30 up.
};

/// Radius and its derivative by azimuth (per radian) at evenly spaced azimuths from 0.
struct RadiusProfile {
    std::vector<double> radius;
    std::vector<double> slope;
};

/// Read a periodic radius function, linear between its samples, at n_segments azimuths.
///
/// The derivative is taken across the segment, or two samples if that is wider; for `Averaged` it
/// is the exact one of the running mean. Works for a segment count that does not divide the radii.
/// @pre At least 3 radii, all positive and finite; n_segments at least 3.
RadiusProfile sample_radii(std::span<const float> radii, int n_segments, RadiusSampling sampling);

/// Area inside the periodic radius function, linear between samples: half the integral of r
/// squared (`rocks-and-deformer.md` A.1). Square units of the radii.
double equatorial_area(std::span<const float> radii);

/// Volume of the generalised ellipsoid (eq. 3.5) over that equator: 4/3 area times depth.
double ellipsoid_volume(std::span<const float> radii, double depth);

}  // namespace scree::meshing
