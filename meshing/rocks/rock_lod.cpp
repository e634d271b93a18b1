#include "meshing/rocks/rock_lod.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/optimise.h"
#include "meshing/mesh/topology.h"
#include "meshing/mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <meshoptimizer.h>

namespace scree::meshing {
namespace {

void drop_collapsed(TriMesh& mesh) {
    const std::vector<std::uint32_t> place = weld_map(mesh);
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return place[t.x] == place[t.y] || place[t.y] == place[t.z] || place[t.z] == place[t.x];
    });
}

LodLevel simplify(const TriMesh& full, std::size_t n_triangles, double max_error) {
    const float* positions = &full.positions.front().x;
    const unsigned int* triangles = &full.triangles.front().x;
    const std::size_t n_vertices = full.positions.size();
    constexpr std::size_t kStride = sizeof(glm::vec3);
    std::vector<unsigned int> indices(3 * full.triangles.size());
    float error = 0.0F;
    const std::size_t n_indices =
        meshopt_simplify(indices.data(), triangles, indices.size(), positions, n_vertices, kStride,
                         3 * n_triangles, static_cast<float>(max_error), 0, &error);
    LodLevel level;
    level.error = static_cast<double>(error) *
                  static_cast<double>(meshopt_simplifyScale(positions, n_vertices, kStride));
    level.mesh.positions = full.positions;
    level.mesh.normals = full.normals;
    level.mesh.texcoords = full.texcoords;
    level.mesh.triangles.reserve(n_indices / 3);
    for (std::size_t i = 0; i < n_indices; i += 3)
        level.mesh.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    return level;
}

}  // namespace

std::vector<LodLevel> build_lod_chain(const TriMesh& mesh, const LodOptions& options) {
    check(options);
    LodLevel full{mesh, 0.0};
    check_mesh(full.mesh);
    drop_collapsed(full.mesh);
    if (full.mesh.triangles.empty())
        fail<InvalidInput>("a mesh without triangles has no levels of detail");
    optimise_for_gpu(full.mesh);
    const bool solid = solid_defect(full.mesh).empty();

    std::vector<LodLevel> chain(1, std::move(full));
    auto wanted = static_cast<double>(chain[0].mesh.triangles.size());
    while (static_cast<int>(chain.size()) < options.levels) {
        wanted *= options.ratio;
        if (wanted < options.min_triangles)
            break;
        LodLevel level =
            simplify(chain[0].mesh, static_cast<std::size_t>(wanted), options.max_error);
        const std::size_t n_triangles = level.mesh.triangles.size();
        if (n_triangles >= chain.back().mesh.triangles.size() ||
            static_cast<int>(n_triangles) < options.min_triangles ||
            (solid && !solid_defect(level.mesh).empty()))
            break;
        optimise_for_gpu(level.mesh);
        level.error = std::max(level.error, chain.back().error);
        chain.push_back(std::move(level));
    }
    return chain;
}

std::vector<std::vector<LodLevel>> build_lod_chains(const std::vector<RockMesh>& rocks,
                                                    const LodOptions& options) {
    check(options);
    std::vector<std::vector<LodLevel>> chains(rocks.size());
    parallel_for_each_index(0, rocks.size(), 4, [&](std::size_t i) {
        chains[i] = build_lod_chain(rocks[i].mesh, options);
    });
    return chains;
}

}  // namespace scree::meshing
