#pragma once

// Behind mean_curvature() alone; not installed.

#include "meshing/curvature/mean_curvature.h"

namespace scree::meshing::curvature {

/// What every estimator reads.
struct Surface {
    const TriMesh& mesh;
    const Adjacency& adjacency;
    std::span<const glm::vec3> normals;
};

inline constexpr std::size_t kGrain = 1024;

void estimate_by_tensor(const Surface& surface, std::vector<float>& of_triangles,
                        std::span<float> curvature);
/// Of one vertex, by the cotangent form.
float cotangent_curvature(const Surface& surface, std::size_t vertex);

void estimate_by_cotangent(const Surface& surface, std::span<float> curvature);
void estimate_by_quadric(const Surface& surface, std::span<float> curvature);

}  // namespace scree::meshing::curvature
