// Mean curvature by Rusinkiewicz's per-face tensors.
//
// The least-squares tensor of a face (`mesh-erosion.md` 2.1, step 2) fits II e_k = D_k for its
// three edges e_k and differences D_k of normals. Edges and differences both add up to zero, so a
// matrix J with J e_k = D_k exists, and the fit is the symmetric II with II S + S II = J S + S J^T,
// S = sum of e_k e_k^T. Multiplying by the inverse of S and taking the trace leaves tr II = tr J:
// the divergence of the normals interpolated over the face. It needs neither a frame nor a solver:
//   tr II = sum over corners k of n_k . (N x e_k) / |N|^2,
// N the cross product of two edges and e_k the edge that faces corner k. Turning a tensor into
// another frame keeps its trace, so step 3 is an average of these numbers.
#include "base/parallel.h"
#include "meshing/curvature/estimators.h"
#include "meshing/mesh/wedges.h"

namespace scree::meshing {
namespace {

constexpr std::size_t kFaceGrain = 2048;

// Half the trace of the face's tensor; 0 without an area.
float face_mean_curvature(const std::vector<glm::vec3>& p, std::span<const glm::vec3> normals,
                          const glm::uvec3& t) {
    const glm::dvec3 origin(p[t.x]);
    const glm::dvec3 b = glm::dvec3(p[t.y]) - origin;
    const glm::dvec3 c = glm::dvec3(p[t.z]) - origin;
    const glm::dvec3 normal = glm::cross(b, c);
    const double square = glm::dot(normal, normal);
    if (!(square > 1e-24 * glm::dot(b, b) * glm::dot(c, c)))
        return 0.0F;
    // n_0.(N x (c - b)) + n_1.(N x -c) + n_2.(N x b), sorted by edges
    const glm::dvec3 n0(normals[t.x]);
    const glm::dvec3 over_b = glm::dvec3(normals[t.z]) - n0;
    const glm::dvec3 over_c = n0 - glm::dvec3(normals[t.y]);
    const double trace =
        (glm::dot(over_b, glm::cross(normal, b)) + glm::dot(over_c, glm::cross(normal, c))) /
        square;
    return static_cast<float>(0.5 * trace);
}

}  // namespace

void face_mean_curvatures(const TriMesh& mesh, std::span<const glm::vec3> normals,
                          std::span<float> of_triangles) {
    parallel_for_each_index(0, of_triangles.size(), kFaceGrain, [&](std::size_t t) {
        of_triangles[t] = face_mean_curvature(mesh.positions, normals, mesh.triangles[t]);
    });
}

namespace curvature {

void estimate_by_tensor(const Surface& surface, std::vector<float>& of_triangles,
                        std::span<float> curvature) {
    const TriMesh& mesh = surface.mesh;
    of_triangles.resize(mesh.triangles.size());
    face_mean_curvatures(mesh, surface.normals, of_triangles);
    parallel_for_each_index(0, curvature.size(), kGrain, [&](std::size_t v) {
        double sum = 0.0;
        double area = 0.0;
        for_each_wedge(mesh, surface.adjacency, v, [&](const Wedge& wedge) {
            const glm::dvec3 normal = wedge.normal();
            const double square = glm::dot(normal, normal);
            if (!(square > 1e-24 * wedge.aa * wedge.bb))
                return;
            const double part = corner_area(wedge, std::sqrt(square));
            sum += part * static_cast<double>(of_triangles[wedge.corner / 3]);
            area += part;
        });
        curvature[v] = area > 0.0 ? static_cast<float>(sum / area) : 0.0F;
    });
}

}  // namespace curvature
}  // namespace scree::meshing
