#include "meshing/mesh/optimise.h"

#include <cstdint>
#include <vector>

#include <meshoptimizer.h>

namespace scree::meshing {
namespace {

constexpr unsigned int kCacheSize = 16;  // vertices; what older graphics chips hold at least

static_assert(sizeof(glm::uvec3) == 3 * sizeof(unsigned int));

template <class Value>
void reorder(std::vector<Value>& values, const std::vector<unsigned int>& remap, std::size_t n) {
    if (values.empty())
        return;
    std::vector<Value> ordered(n);
    meshopt_remapVertexBuffer(ordered.data(), values.data(), values.size(), sizeof(Value),
                              remap.data());
    values = std::move(ordered);
}

}  // namespace

void optimise_for_gpu(TriMesh& mesh) {
    check_mesh(mesh);
    const std::size_t n_indices = 3 * mesh.triangles.size();
    if (n_indices == 0) {
        mesh = {};
        return;
    }
    std::vector<unsigned int> indices(n_indices);
    const unsigned int* triangles = &mesh.triangles.front().x;
    // Of a fifth of the cost of the full search; the meshes are small and strips to begin with.
    meshopt_optimizeVertexCacheFifo(indices.data(), triangles, n_indices, mesh.positions.size(),
                                    kCacheSize);
    std::vector<unsigned int> remap(mesh.positions.size());
    const std::size_t n_used = meshopt_optimizeVertexFetchRemap(remap.data(), indices.data(),
                                                                n_indices, mesh.positions.size());
    meshopt_remapIndexBuffer(indices.data(), indices.data(), n_indices, remap.data());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        mesh.triangles[t] = {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]};
    reorder(mesh.positions, remap, n_used);
    reorder(mesh.normals, remap, n_used);
    reorder(mesh.texcoords, remap, n_used);
}

}  // namespace scree::meshing
