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

double greatest_side(const TriMesh& mesh) {
    return static_cast<double>(
        meshopt_simplifyScale(&mesh.positions.front().x, mesh.positions.size(), sizeof(glm::vec3)));
}

// Each level is made of the one before. The simplifier's error is the root of a mean square of
// distances; those of one step say nothing of those of the next, so their squares add up.
LodLevel simplify(const LodLevel& finer, std::size_t n_triangles, double most_error) {
    const TriMesh& mesh = finer.mesh;
    const double scale = greatest_side(mesh);
    const double left = most_error * most_error - finer.error * finer.error;
    const double allowed = std::sqrt(std::max(0.0, left)) / scale;
    std::vector<unsigned int> indices(3 * mesh.triangles.size());
    float error = 0.0F;
    const std::size_t n_indices =
        meshopt_simplify(indices.data(), &mesh.triangles.front().x, indices.size(),
                         &mesh.positions.front().x, mesh.positions.size(), sizeof(glm::vec3),
                         3 * n_triangles, static_cast<float>(allowed), 0, &error);
    LodLevel level;
    level.error = std::hypot(finer.error, static_cast<double>(error) * scale);
    level.mesh.positions = mesh.positions;
    level.mesh.normals = mesh.normals;
    level.mesh.texcoords = mesh.texcoords;
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
    const double most_error = options.max_error * greatest_side(chain[0].mesh);
    auto wanted = static_cast<double>(chain[0].mesh.triangles.size());
    while (static_cast<int>(chain.size()) < options.levels) {
        wanted *= options.ratio;
        if (wanted < options.min_triangles)
            break;
        LodLevel level = simplify(chain.back(), static_cast<std::size_t>(wanted), most_error);
        const std::size_t n_triangles = level.mesh.triangles.size();
        if (n_triangles >= chain.back().mesh.triangles.size() ||
            static_cast<int>(n_triangles) < options.min_triangles ||
            (solid && !solid_defect(level.mesh).empty()))
            break;
        optimise_for_gpu(level.mesh);
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
