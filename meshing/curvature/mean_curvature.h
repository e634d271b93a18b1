#pragma once

#include "base/options.h"
#include "meshing/mesh/adjacency.h"

#include <span>
#include <string_view>
#include <vector>

namespace scree::meshing {

/// How mean curvature is estimated. All give half the sum of the principal curvatures, in one
/// over metres: positive on hills, negative in valleys.
enum class CurvatureMethod {
    Tensor,     ///< Per-face tensors from the normals (Rusinkiewicz 2004); the source's, fastest.
    Cotangent,  ///< Cotangent form of the Laplace-Beltrami operator; wrong on uneven triangles.
    Quadric,    ///< Surface of second order through two rings of neighbours; most accurate.
};

inline constexpr std::string_view kCurvatureMethodNames[] = {"tensor", "cotangent", "quadric"};

constexpr std::span<const std::string_view> names_of(CurvatureMethod) {
    return kCurvatureMethodNames;
}

/// Mean curvature at every vertex (`mesh-erosion.md` 2.1); 0 where no triangle has an area.
///
/// On a rim the data are one-sided: leave rim vertices out of ranges. Runs in parallel, the same
/// numbers for any number of threads.
/// @param normals  Of the vertices, outwards, as vertex_normals() gives them.
/// @throw InvalidInput  the adjacency or the normals are not as long as the mesh.
std::vector<float> mean_curvature(const TriMesh& mesh, const Adjacency& adjacency,
                                  std::span<const glm::vec3> normals,
                                  CurvatureMethod method = CurvatureMethod::Tensor);

/// Memory that the estimators use between calls.
struct CurvatureScratch {
    std::vector<float> of_triangles;
};

/// The same into an array of the right length.
void mean_curvature(const TriMesh& mesh, const Adjacency& adjacency,
                    std::span<const glm::vec3> normals, CurvatureMethod method,
                    CurvatureScratch& scratch, std::span<float> curvature);

/// Half the trace of every triangle's curvature tensor: what CurvatureMethod::Tensor averages over
/// the triangles around a vertex. 0 where a triangle has no area.
/// @pre  As many normals as vertices, as many results as triangles.
void face_mean_curvatures(const TriMesh& mesh, std::span<const glm::vec3> normals,
                          std::span<float> of_triangles);

}  // namespace scree::meshing
