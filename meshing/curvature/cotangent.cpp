// Mean curvature by the cotangent form of the Laplace-Beltrami operator (Meyer et al. 2003):
//   2 H n = sum over neighbours of (cot alpha + cot beta) (v_i - v_j) / (2 A_mixed).
#include "base/parallel.h"
#include "meshing/curvature/estimators.h"
#include "meshing/mesh/wedges.h"

namespace scree::meshing::curvature {

float cotangent_curvature(const Surface& surface, std::size_t vertex) {
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for_each_wedge(surface.mesh, surface.adjacency, vertex, [&](const Wedge& wedge) {
        const glm::dvec3 normal = wedge.normal();
        const double square = glm::dot(normal, normal);
        if (!(square > 1e-24 * wedge.aa * wedge.bb))
            return;
        const double twice_area = std::sqrt(square);
        const double ab = wedge.ab();
        // The angle that faces edge a lies at the end of edge b, and the other way round.
        sum -= (wedge.a * (wedge.bb - ab) + wedge.b * (wedge.aa - ab)) / twice_area;
        area += corner_area(wedge, twice_area);
    });
    if (!(area > 0.0))
        return 0.0F;
    return static_cast<float>(glm::dot(sum, glm::dvec3(surface.normals[vertex])) / (4.0 * area));
}

void estimate_by_cotangent(const Surface& surface, std::span<float> curvature) {
    parallel_for_each_index(0, curvature.size(), kGrain,
                            [&](std::size_t v) { curvature[v] = cotangent_curvature(surface, v); });
}

}  // namespace scree::meshing::curvature
