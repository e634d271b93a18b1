#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace scree::meshing {

/// Distances from a direction to the three nearest feature points, along the unit sphere, radians.
struct WorleyDistances {
    double first = 0.0;
    double second = 0.0;
    double third = 0.0;
};

/// Feature points on the unit sphere, ordered by height, one in each of n bands of equal area.
/// @throw InvalidOption  n is not in [3, 1e6].
std::vector<glm::dvec3> scatter_on_sphere(int n, std::uint64_t seed);

/// Cellular noise on the unit sphere (`rocks-and-deformer.md` part B): continuous everywhere, with
/// creases along the borders of cells.
class SphericalWorley {
public:
    /// @throw InvalidOption  n_points is not in [3, 1e6].
    SphericalWorley(int n_points, std::uint64_t seed);

    const std::vector<glm::dvec3>& points() const { return points_; }

    /// Looks only at points whose height is near enough. @pre `direction` has unit length.
    WorleyDistances distances(const glm::dvec3& direction) const;

    /// The same by looking at every point.
    WorleyDistances distances_by_search(const glm::dvec3& direction) const;

private:
    std::vector<glm::dvec3> points_;
    std::vector<double> elevations_;  // of points_, rising
};

}  // namespace scree::meshing
