#include "meshing/curvature/mean_curvature.h"

#include "base/error.h"
#include "meshing/curvature/estimators.h"

namespace scree::meshing {

void mean_curvature(const TriMesh& mesh, const Adjacency& adjacency,
                    std::span<const glm::vec3> normals, CurvatureMethod method,
                    CurvatureScratch& scratch, std::span<float> curvature) {
    const std::size_t n = mesh.positions.size();
    if (adjacency.n_vertices() != n || normals.size() != n || curvature.size() != n)
        fail<InvalidInput>("the mesh has ", n, " vertices, its adjacency ", adjacency.n_vertices(),
                           ", the normals ", normals.size(), " and the curvature ",
                           curvature.size());
    const curvature::Surface surface{mesh, adjacency, normals};
    switch (method) {
        case CurvatureMethod::Tensor:
            curvature::estimate_by_tensor(surface, scratch.of_triangles, curvature);
            break;
        case CurvatureMethod::Cotangent:
            curvature::estimate_by_cotangent(surface, curvature);
            break;
        case CurvatureMethod::Quadric:
            curvature::estimate_by_quadric(surface, curvature);
            break;
    }
}

std::vector<float> mean_curvature(const TriMesh& mesh, const Adjacency& adjacency,
                                  std::span<const glm::vec3> normals, CurvatureMethod method) {
    std::vector<float> result(mesh.positions.size());
    CurvatureScratch scratch;
    mean_curvature(mesh, adjacency, normals, method, scratch, result);
    return result;
}

}  // namespace scree::meshing
